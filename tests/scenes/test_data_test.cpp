// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/test_data.hpp"

#include <gmock/gmock.h>

namespace farlod::scenes {
namespace {

using testing::HasSubstr;

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

TEST_F(TestData, ASkippedTestNamesTheVariable) { EXPECT_THAT(absence_of("a/b"), HasSubstr("no a/b: FARLOD_TEST_DATA")); }

}  // namespace
}  // namespace farlod::scenes
