// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/document_names.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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

}  // namespace
}  // namespace farlod
