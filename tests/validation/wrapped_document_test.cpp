// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/wrapped_document.hpp"

#include <gtest/gtest.h>

namespace farlod::validation {
namespace {

const std::string fifty_four(54, 'a'), fifty_five(55, 'b');

TEST(WrappedDocument, LinesOfParagraphsEndAfter110Characters) {
  EXPECT_EQ(wrapped_document(fifty_four + " " + fifty_five + "\n"), fifty_four + " " + fifty_five + "\n");
  EXPECT_EQ(wrapped_document(fifty_five + " " + fifty_five + "\n"), fifty_five + "\n" + fifty_five + "\n");
  EXPECT_EQ(wrapped_document("a\n\nb\n"), "a\n\nb\n");
}

TEST(WrappedDocument, CharactersAreCountedAndNotBytes) {
  std::string dashes;
  for (int n = 0; n < 54; ++n) dashes += "–";
  EXPECT_EQ(wrapped_document(dashes + " " + fifty_five + "\n"), dashes + " " + fifty_five + "\n");
}

TEST(WrappedDocument, ALongWordStaysWhole) {
  const std::string word(120, 'w');
  EXPECT_EQ(wrapped_document("a " + word + " b\n"), "a\n" + word + "\nb\n");
  EXPECT_EQ(wrapped_document(word + " b\n"), word + "\nb\n");
}

TEST(WrappedDocument, ACodeSpanStaysOnOneLine) {
  EXPECT_EQ(wrapped_document(fifty_five + " `a " + fifty_five + "` b\n"), fifty_five + "\n`a " + fifty_five + "` b\n");
  EXPECT_EQ(wrapped_document("a `never closed\n"), "a `never closed\n");
}

TEST(WrappedDocument, TablesHeadingsAndPicturesStayWhole) {
  for (const std::string mark : {"| ", "## ", "!["}) {
    const std::string line = mark + fifty_five + " " + fifty_five + "\n";
    EXPECT_EQ(wrapped_document(line), line);
  }
}

TEST(WrappedDocument, ItemsOfListsAreIndented) {
  EXPECT_EQ(wrapped_document("* " + fifty_five + " " + fifty_five + "\n"), "* " + fifty_five + "\n  " + fifty_five + "\n");
}

}  // namespace
}  // namespace farlod::validation
