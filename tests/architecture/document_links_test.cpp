// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/document_links.hpp"

#include <gmock/gmock.h>

#include <filesystem>

namespace farlod {
namespace {

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

}  // namespace
}  // namespace farlod
