// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/vocabulary.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path source_root = FARLOD_SOURCE_DIR;

/// All but the tests of the list, and the changelog, which tells old names.
std::vector<SourceFile> texts() {
  std::vector<SourceFile> files = read_source_tree(source_root), documents = read_documents(source_root);
  files.insert(files.end(), documents.begin(), documents.end());
  std::erase_if(
      files, [](const SourceFile& f) { return f.path == "CHANGELOG.md" || f.path.starts_with("tests/architecture/vocabulary"); });
  return files;
}

TEST(Vocabulary, NoRetiredWordIsLeft) {
  EXPECT_THAT(find_retired_words(texts(), read_retired_words(source_root / "tests/architecture/retired_words.txt")), IsEmpty());
}

TEST(Vocabulary, NamesAndProseAreReadAsWords) {
  EXPECT_EQ(words_of("class UnnamedCity : unnamed_city2 {"), " class unnamed city unnamed city ");
  EXPECT_EQ(words_of(""), " ");
}

TEST(Vocabulary, APhraseIsFoundHoweverItIsWritten) {
  const std::vector<RetiredWord> words{{"unnamed city", "residual horizon", false}};
  EXPECT_THAT(
      find_retired_words({{"a.cpp", {"", "UnnamedCity city;", "the unnamed", "unnamed_city_", "// The unnamed city"}}}, words),
      ElementsAre(HasSubstr("a.cpp:2: unnamed city -> residual horizon"), HasSubstr("a.cpp:4"), HasSubstr("a.cpp:5")));
}

TEST(Vocabulary, AnIdentifierIsFoundAsAWhole) {
  const std::vector<RetiredWord> words{{"likely", "estimate", true}};
  EXPECT_THAT(find_retired_words({{"a.cpp", {"likely = 1;", "unlikely", "likely_", "x.likely", "a;  // likely"}}}, words),
              ElementsAre(HasSubstr("a.cpp:1"), HasSubstr("a.cpp:4")));
}

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
