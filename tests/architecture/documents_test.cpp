// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "farlod/version.hpp"

namespace farlod {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(DocumentLinks, LeadSomewhereInThisTree) {
  const std::filesystem::path root = FARLOD_SOURCE_DIR;
  const std::vector<SourceFile> documents = read_documents(root);
  ASSERT_GT(documents.size(), 30U) << "the documents were not found at " << root;
  EXPECT_THAT(dead_links(documents, [&](const std::string& path) { return std::filesystem::exists(root / path); }), IsEmpty());
}

/// A project of two documents and a picture; the lines are those of docs/a.md.
std::vector<std::string> dead_links_of(const std::vector<std::string>& lines) {
  const std::vector<SourceFile> documents{
      {"docs/a.md", lines}, {"docs/deep/b.md", {"# Heights, of `--base` & more", "## Twice", "## Twice", "## Façades"}}};
  return dead_links(documents, [](const std::string& path) {
    return path == "docs/a.md" || path == "docs/deep/b.md" || path == "docs/picture.png" || path == "README.md";
  });
}

TEST(DocumentLinks, AMissingFileIsFound) {
  EXPECT_THAT(
      dead_links_of({"[b](deep/b.md), [c](deep/c.md) and [up](../README.md)", "![p](picture.png) ![q](picture.jpg \"q\")"}),
      ElementsAre("docs/a.md:1 deep/c.md", "docs/a.md:2 picture.jpg"));
}

TEST(DocumentLinks, AMissingHeadingIsFound) {
  EXPECT_THAT(
      dead_links_of({"# Here", "[1](#here) [2](#there)", "[3](deep/b.md#heights-of---base--more) [4](deep/b.md#heights)"}),
      ElementsAre("docs/a.md:2 #there", "docs/a.md:3 deep/b.md#heights"));
}

TEST(DocumentLinks, HeadingsOfTheSameWordsAreCounted) {
  EXPECT_THAT(dead_links_of({"[1](deep/b.md#twice) [2](deep/b.md#twice-1) [3](deep/b.md#twice-2) [4](deep/b.md#façades)"}),
              ElementsAre("docs/a.md:1 deep/b.md#twice-2"));
}

TEST(DocumentLinks, OtherFormsOfALinkAreFollowed) {
  EXPECT_THAT(dead_links_of({"[name]: gone.md", "<img src=\"gone.png\">", "[`code`](gone.hpp)"}),
              ElementsAre("docs/a.md:1 gone.md", "docs/a.md:2 gone.png", "docs/a.md:3 gone.hpp"));
}

TEST(DocumentLinks, CodeAndOtherPlacesAreNotFollowed) {
  EXPECT_THAT(dead_links_of({"[web](https://example.org/gone.md) [mail](mailto:a@example.org)", "`[a](gone.md)`", "```",
                             "[a](gone.md)", "# no heading", "```"}),
              IsEmpty());
}

TEST(DocumentNames, AreThoseOfThisTree) {
  std::vector<SourceFile> documents = read_documents(FARLOD_SOURCE_DIR);
  ASSERT_GT(documents.size(), 30U) << "the documents were not found at " << FARLOD_SOURCE_DIR;
  // The changelog tells old names
  std::erase_if(documents, [](const SourceFile& document) { return document.path == "CHANGELOG.md"; });
  const std::vector<SourceFile> texts = read_all_texts(FARLOD_SOURCE_DIR);
  EXPECT_THAT(dead_names(documents, NamedTree(texts)), IsEmpty());
}

std::vector<std::string> dead_names_of(const std::vector<std::string>& lines) {
  const std::vector<SourceFile> texts{{"docs/stages/a.md", {"gone_function"}},
                                      {"runtime/scene/plan_index.hpp", {"class PlanIndex {", "  double find_height();"}},
                                      {"runtime/scene/plan_index.cpp", {}},
                                      {"include/farlod/version.hpp.in", {}},
                                      {"scripts/test", {"cmake --build"}}};
  return dead_names({{"docs/stages/a.md", lines}}, NamedTree(texts));
}

TEST(DocumentNames, APathThatIsGoneIsFound) {
  EXPECT_THAT(dead_names_of({"`runtime/scene/plan_index.hpp`, `runtime/scene/`, `runtime/scene/plan_index`, `scripts/test`",
                             "`runtime/gone/plan_index.hpp`, `runtime/scene/plan`, `../stages/a.md`, `stages/gone.md`",
                             "`runtime/*/plan_index.*`, `runtime/*/gone.*`, `include/farlod/version.hpp`, `town/a.gml`"}),
              ElementsAre("docs/stages/a.md:2 runtime/gone/plan_index.hpp", "docs/stages/a.md:2 runtime/scene/plan",
                          "docs/stages/a.md:3 runtime/*/gone.*"));
}

TEST(DocumentNames, AFileThatIsGoneIsFound) {
  EXPECT_THAT(dead_names_of({"`plan_index.hpp`, `version.hpp`, `gone.hpp`", "`plan.hpp`, `town.gml`, `.hpp`"}),
              ElementsAre("docs/stages/a.md:1 gone.hpp", "docs/stages/a.md:2 plan.hpp"));
}

TEST(DocumentNames, AFunctionThatIsGoneIsFound) {
  EXPECT_THAT(
      dead_names_of({"`find_height()`, `PlanIndex::find_height`, `gone_function()`", "`PlanIndex::gone`, `std::expected`"}),
      ElementsAre("docs/stages/a.md:1 gone_function()", "docs/stages/a.md:2 PlanIndex::gone"));
}

TEST(DocumentNames, ANameInAnotherFileIsFound) {
  EXPECT_THAT(dead_names_of({"`PlanIndex` (`plan_index.hpp`)", "`PlanIndex` (`scene/plan_index.cpp`)"}),
              ElementsAre("docs/stages/a.md:2 PlanIndex in scene/plan_index.cpp"));
}

TEST(DocumentNames, BlocksOfCodeAreNotRead) { EXPECT_THAT(dead_names_of({"```", "`runtime/gone`", "```"}), IsEmpty()); }

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
