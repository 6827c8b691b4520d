// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/svg_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/scenes/packed_city.hpp"
#include "validation/wrapped_document.hpp"

namespace farlod::validation {
namespace {

std::string svg_of(const Plot& plot) {
  const scenes::TemporaryFolder folder;
  write_svg(plot, folder.path() / "plot.svg");
  std::ostringstream text;
  text << std::ifstream(folder.path() / "plot.svg").rdbuf();
  return text.str();
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(SvgPlot, NamesItsAxesAndLines) {
  const std::string svg =
      svg_of({"title", {"across", Scale::linear}, {"up", Scale::logarithmic}, {{"a < b", 0, false, {{1, 1}, {2, 30}}}}});
  for (const char* text : {">title<", ">across<", ">up<", ">a &lt; b<"}) EXPECT_THAT(svg, testing::HasSubstr(text));
}

TEST(SvgPlot, LogarithmicAxisLeavesOutWhatItCannotShow) {
  const Series series{"errors", 0, false, {{1, 0.0}, {10, 0.01}, {100, 0.1}}};
  EXPECT_EQ(count_of(svg_of({"", {"x", Scale::logarithmic}, {"y", Scale::logarithmic}, {series}}), "<circle"), 2U);
  EXPECT_EQ(count_of(svg_of({"", {"x", Scale::linear}, {"y", Scale::linear}, {series}}), "<circle"), 3U);
}

TEST(SvgPlot, SaysThatItCannotWrite) {
  const Plot plot{"", {"x", Scale::linear}, {"y", Scale::linear}, {{"", 0, false, {{0, 1}, {1, 2}}}}};
  EXPECT_THROW(write_svg(plot, "/nowhere/plot.svg"), std::runtime_error);
}

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
