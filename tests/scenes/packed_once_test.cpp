// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/packed_once.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <stdexcept>

#include "tests/scenes/temporary_folder.hpp"
#include "tests/scenes/test_data.hpp"

namespace farlod::scenes {
namespace {

namespace fs = std::filesystem;

class PackedOnce : public testing::Test {
 protected:
  /// Packs the text, and counts how often.
  fs::path packed(const std::string& text) {
    const fs::path folder = packed_once({name_, text, folder_.file("program")}, [&](const fs::path& into) {
      ++times_;
      return write(into / "map", text);
    });
    made_.push_back(folder);
    return folder;
  }
  static bool write(const fs::path& path, const std::string& text) { return static_cast<bool>(std::ofstream(path) << text); }
  void set_program(const std::string& bytes) const { EXPECT_TRUE(write(folder_.file("program"), bytes)); }

  void SetUp() override { set_program("one"); }
  void TearDown() override {
    for (const fs::path& folder : made_) fs::remove_all(folder);
  }

  TemporaryFolder folder_;
  /// Tests of one build may run at the same time.
  std::string name_ = "packed_once_" + folder_.path().filename().string();
  std::vector<fs::path> made_;
  int times_ = 0;
};

TEST_F(PackedOnce, ASecondTestFindsWhatTheFirstPacked) {
  const fs::path first = packed("town");
  EXPECT_EQ(packed("town"), first);
  EXPECT_EQ(times_, 1);
  EXPECT_EQ(text_of(first / "map"), "town");
}

TEST_F(PackedOnce, AnotherProgramPacksAnewAndTheOlderPackageGoes) {
  const fs::path first = packed("town");
  set_program("two");
  const fs::path second = packed("town");
  EXPECT_NE(first, second);
  EXPECT_EQ(times_, 2);
  EXPECT_FALSE(fs::exists(first));
  EXPECT_EQ(text_of(second / "map"), "town");
}

TEST_F(PackedOnce, AnotherTextPacksAnew) {
  (void)packed("town");
  EXPECT_EQ(text_of(packed("city") / "map"), "city");
  EXPECT_EQ(times_, 2);
}

TEST_F(PackedOnce, APackageOfAnotherNameStays) {
  const fs::path first = packed("town");
  name_ += "-more";
  (void)packed("town");
  EXPECT_TRUE(fs::exists(first));
}

TEST_F(PackedOnce, WhoIsSlowerTakesThePackageOfWhoIsFaster) {
  const PackedFrom from{name_, "town", folder_.file("program")};
  made_.push_back(packed_once(from, [&](const fs::path& into) {
    EXPECT_EQ(packed("town").parent_path(), into.parent_path());
    return write(into / "map", "slower");
  }));
  EXPECT_EQ(text_of(made_.back() / "map"), "town");
}

TEST_F(PackedOnce, NothingIsKeptOfWhatFailed) {
  const PackedFrom from{name_, "town", folder_.file("program")};
  fs::path unfinished;
  EXPECT_THROW((void)packed_once(from,
                                 [&](const fs::path& into) {
                                   unfinished = into;
                                   (void)write(into / "map", "half");
                                   return false;
                                 }),
               std::runtime_error);
  EXPECT_FALSE(fs::exists(unfinished));
  (void)packed("town");
  EXPECT_EQ(times_, 1);
}

/// Gives the variable back what it had.
class TestData : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* value = std::getenv(variable)) before_ = value;
  }
  void TearDown() override { before_.empty() ? unsetenv(variable) : setenv(variable, before_.c_str(), 1); }

  static constexpr const char* variable = "FARLOD_TEST_DATA";

 private:
  std::string before_;
};

TEST_F(TestData, LiesWhereTheVariableSays) {
  setenv(variable, "/somewhere/cities", 1);
  EXPECT_EQ(test_data("omiya/omiya.geojson"), "/somewhere/cities/omiya/omiya.geojson");
}

TEST_F(TestData, LiesBesideTheProjectWithoutTheVariable) {
  const std::filesystem::path beside = std::filesystem::path(FARLOD_SHARED_DATA_DIR) / "omiya";
  unsetenv(variable);
  EXPECT_EQ(test_data("omiya"), beside);
  setenv(variable, "", 1);
  EXPECT_EQ(test_data("omiya"), beside);
}

TEST_F(TestData, ASkippedTestNamesTheVariable) { EXPECT_THAT(absence_of("a/b"), testing::HasSubstr("no a/b: FARLOD_TEST_DATA")); }

}  // namespace
}  // namespace farlod::scenes
