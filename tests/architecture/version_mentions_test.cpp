// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/version_mentions.hpp"

#include <gmock/gmock.h>

#include "farlod/version.hpp"

namespace farlod {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

const std::filesystem::path root = FARLOD_SOURCE_DIR;

/// Moves the file of this path out of the list.
SourceFile taken(std::vector<SourceFile>& files, const std::string& path) {
  SourceFile file;
  std::erase_if(files, [&](const SourceFile& f) {
    if (f.path == path) file = f;
    return f.path == path;
  });
  return file;
}

TEST(Version, StandsInOnePlace) {
  std::vector<SourceFile> files = read_all_texts(root);
  const SourceFile changelog = taken(files, "CHANGELOG.md"), lists = taken(files, "CMakeLists.txt");
  // QGIS reads it there, and a plug-in is installed without a build step
  const SourceFile plug_in = taken(files, "qgis/farlod/metadata.txt");
  // Hosts and libraries read what is to be cited there, from the tree
  const SourceFile citation = taken(files, "CITATION.cff");
  // Packages say which release wrote them, for ever
  std::erase_if(files, [](const SourceFile& f) {
    return f.path.starts_with("tests/fuzz/corpus/");
  });
  EXPECT_EQ(mentions_of_version({lists}, software_version).size(), 1U);
  EXPECT_THAT(mentions_of_version(files, software_version), IsEmpty()) << "CMakeLists.txt alone says the version";
  EXPECT_THAT(plug_in.lines, Contains(std::string("version=") + software_version));
  EXPECT_THAT(citation.lines, Contains(std::string("version: ") + software_version));
  EXPECT_EQ(topmost_release(changelog), software_version);
}

TEST(Version, IsMadeOfItsNumbers) {
  EXPECT_EQ(std::to_string(version_major) + "." + std::to_string(version_minor) + "." + std::to_string(version_patch),
            software_version);
}

TEST(Version, AMentionIsFound) {
  const std::vector<std::string> lines{"7.8.9",   "Since 7.8.9.", "v7.8.9-2", "17.8.9 and 7.8.9", "7.8.90", "17.8.9", "6.7.8.9",
                                       "7.8.9.1", "version 7",    "7x8x9",    "\"7.8.9\"",        ""};
  EXPECT_THAT(mentions_of_version({{"a.cmake", lines}, {"b.md", {"7.8.8"}}}, "7.8.9"),
              ElementsAre("a.cmake:1", "a.cmake:2", "a.cmake:3", "a.cmake:4", "a.cmake:11"));
}

TEST(Version, TheTopmostReleaseIsFound) {
  EXPECT_EQ(topmost_release({"a.md", {"# Changelog", "", "## [Unreleased]", "", "## [7.8.9] - 2000-01-31", "## [7.8.8]"}}),
            "7.8.9");
  EXPECT_EQ(topmost_release({"a.md", {"## [7.10.0]"}}), "7.10.0");
  EXPECT_EQ(topmost_release({"a.md", {"# Changelog", "## [Unreleased]", "### 7.8.9"}}), "");
}

}  // namespace
}  // namespace farlod
