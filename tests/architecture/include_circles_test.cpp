// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/include_circles.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(IncludeCircles, FoldersOfPreprocessFormNone) {
  EXPECT_THAT(include_circles(read_source_tree(FARLOD_SOURCE_DIR), "preprocess/"), IsEmpty());
}

TEST(IncludeCircles, AFolderAndItsOwnSubfolderAreFound) {
  const std::vector<SourceFile> tree{{"preprocess/ingest/ingest.cpp", {"#include \"ingest/obj/reader.hpp\""}},
                                     {"preprocess/ingest/model.hpp", {}},
                                     {"preprocess/ingest/obj/reader.hpp", {"#include \"ingest/model.hpp\""}}};
  EXPECT_THAT(include_circles(tree, "preprocess/"),
              ElementsAre(AllOf(StartsWith("preprocess/ingest -> preprocess/ingest/obj -> preprocess/ingest: "),
                                HasSubstr("preprocess/ingest/ingest.cpp includes ingest/obj/reader.hpp"),
                                HasSubstr("preprocess/ingest/obj/reader.hpp includes ingest/model.hpp"))));
}

TEST(IncludeCircles, ALongCircleIsFound) {
  const std::vector<SourceFile> tree{{"preprocess/a/a.hpp", {"#include \"b/b.hpp\""}},
                                     {"preprocess/b/b.hpp", {"#include \"c/c.hpp\""}},
                                     {"preprocess/c/c.hpp", {"#include \"a/a.hpp\""}},
                                     {"preprocess/d/d.hpp", {"#include \"a/a.hpp\""}}};
  EXPECT_THAT(include_circles(tree, "preprocess/"), ElementsAre(StartsWith("preprocess/a -> preprocess/b -> preprocess/c -> ")));
}

TEST(IncludeCircles, SharedFoldersAndOtherSidesAreNone) {
  const std::vector<SourceFile> tree{{"preprocess/a/a.hpp", {"#include \"b/b.hpp\"", "#include \"c/c.hpp\""}},
                                     {"preprocess/b/b.hpp", {"#include \"c/c.hpp\"", "#include \"farlod/grid.hpp\""}},
                                     {"preprocess/c/c.hpp", {"#include \"c/d.hpp\"", "#include <vector>"}},
                                     {"preprocess/c/d.hpp", {}},
                                     {"runtime/c/c.hpp", {"#include \"a/a.hpp\""}}};
  EXPECT_THAT(include_circles(tree, "preprocess/"), IsEmpty());
}

}  // namespace
}  // namespace farlod
