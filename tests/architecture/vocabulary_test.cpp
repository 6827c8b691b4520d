// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/vocabulary.hpp"

#include <gmock/gmock.h>

#include <algorithm>

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

}  // namespace
}  // namespace farlod
