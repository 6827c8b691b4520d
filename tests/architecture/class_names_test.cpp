// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/class_names.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ClassNames, HaveOneDefinitionInThisTree) {
  const std::vector<SourceFile> tree = read_source_tree(FARLOD_SOURCE_DIR);
  EXPECT_THAT(classes_defined_twice(tree), IsEmpty());
  std::size_t count = 0;
  for (const SourceFile& file : tree) count += class_definitions(file).size();
  EXPECT_GT(count, 400U) << "the definitions of this tree were not found";
}

TEST(ClassNames, AreFoundWithTheirScopes) {
  const SourceFile file{"preprocess/a/a.hpp",
                        {"#define OPEN {",                                    //
                         "namespace farlod::a {",                             //
                         "enum class Kind : std::uint8_t { one, two };",      //
                         "struct Forward;",                                   //
                         "template <class T> struct Box final : Base<T> {",   //
                         "  struct Lid { int n = 1'000; };  // }",            //
                         "  bool is_open() const { return text == \"{\"; }",  //
                         "};",                                                //
                         "inline void work() { struct Local { int n; }; }",   //
                         "struct Box2::Impl { int n; };",                     //
                         "namespace {",                                       //
                         "struct Private { };",                               //
                         "}",                                                 //
                         "class Last { };",                                   //
                         "}"}};
  EXPECT_THAT(class_definitions(file), ElementsAre("farlod::a::Kind", "farlod::a::Box", "farlod::a::Box::Lid",
                                                   "farlod::a::Box2::Impl", "farlod::a::Last"));
}

TEST(ClassNames, ANameOfTwoModulesIsFound) {
  const std::vector<std::string> unit{"namespace farlod {", "struct LengthUnit { };", "}"};
  const std::vector<std::string> other{"namespace farlod {", "enum class LengthUnit { metre, foot };", "}"};
  const std::vector<std::string> of_module{"namespace farlod::ingest {", "enum class LengthUnit { metre, foot };", "}"};
  EXPECT_THAT(classes_defined_twice({{"preprocess/a/crs.hpp", unit}, {"preprocess/b/text.hpp", other}}),
              ElementsAre("farlod::LengthUnit is defined in preprocess/a/crs.hpp preprocess/b/text.hpp"));
  EXPECT_THAT(classes_defined_twice({{"preprocess/a/crs.hpp", unit}, {"preprocess/b/text.hpp", of_module}}), IsEmpty());
  EXPECT_THAT(classes_defined_twice({{"preprocess/a/crs.hpp", unit}, {"tests/b/text.hpp", other}}), IsEmpty());
}

}  // namespace
}  // namespace farlod
