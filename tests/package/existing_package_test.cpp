// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/existing_package.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "package/layout.hpp"
#include "package/manifest_reader.hpp"
#include "tests/scenes/sealed_manifest.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// In `text` from `begin` on, `from` once replaced by `to`.
std::string replaced(std::string text, std::size_t begin, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from, begin);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

/// The manifest of a package some of whose cells have far maps; nothing else of the package is there.
class PackageToGoOnWith : public testing::Test {
 protected:
  PackageToGoOnWith() { fs::create_directory(package_); }
  void write(const std::string& text) const { std::ofstream(package_ / package::manifest_file, std::ios::binary) << text; }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)ExistingPackage::find(package_);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "no refusal";
  }

  scenes::TemporaryFolder folder_;
  fs::path package_ = folder_.file("town.farlod");
  std::string text_ = scenes::text_of(FARLOD_GOLDEN_DIR "/version_8_horizon_partial.farlod/manifest.json");
};

TEST_F(PackageToGoOnWith, HasTheBlocksThatTheRuntimeReads) {
  EXPECT_FALSE(ExistingPackage::find(package_));
  write(text_);
  const auto existing = ExistingPackage::find(package_);
  ASSERT_TRUE(existing);
  const std::vector<package::BlockFiles> read = read_manifest(package_).blocks;
  ASSERT_GT(read.size(), 0U);
  ASSERT_EQ(existing->blocks().size(), read.size());
  for (std::size_t n = 0; n < read.size(); ++n) {
    EXPECT_EQ(existing->blocks()[n].block, read[n].block);
    EXPECT_EQ(existing->blocks()[n].tiles, read[n].tiles);
    EXPECT_EQ(package::folder_of(existing->blocks()[n]), package::folder_of(read[n]));
  }
}

TEST_F(PackageToGoOnWith, OfAnOlderVersionIsRefusedWithWhatToDo) {
  for (const std::string version : {"6", "7"}) {
    write(scenes::sealed(replaced(text_, 0, "\"version\": 8", "\"version\": " + version)));
    EXPECT_THAT(refusal(),
                AllOf(HasSubstr("has format version " + version), HasSubstr("Pack the city again"), HasSubstr("--force")));
  }
}

/// Each would be cut to another number that looks right. The program that goes on with a package and those that read it refuse
/// the same ones.
TEST_F(PackageToGoOnWith, WithANumberThatDoesNotFitIsRefusedByBothPrograms) {
  const std::size_t blocks = text_.find("\"blocks\"");
  const std::string whole = replaced(text_, blocks, "\"i\": 0", "\"i\":  0");
  write(scenes::sealed(whole));
  ASSERT_EQ(refusal(), "no refusal");
  const std::pair<std::string, std::string> changes[] = {{"\"i\": 0", "\"i\": 4294967296"},
                                                         {"\"j\": 0", "\"j\": 0.5"},
                                                         {"\"bytes\": ", "\"bytes\": -"},
                                                         {"\"bytes\": ", "\"bytes\": 9999999999999999"}};
  for (const auto& [from, to] : changes) {
    write(scenes::sealed(replaced(text_, blocks, from, to)));
    EXPECT_THAT(refusal(), HasSubstr("manifest.json is damaged")) << to;
    EXPECT_THROW((void)read_manifest(package_), PackageDamaged) << to;
  }
}

TEST_F(PackageToGoOnWith, WithAnotherChecksumIsRefused) {
  write(" " + text_);
  EXPECT_THAT(refusal(), HasSubstr("manifest.json is damaged: its checksum"));
}

}  // namespace
}  // namespace farlod
