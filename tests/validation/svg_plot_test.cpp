// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/svg_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/scenes/packed_city.hpp"

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

}  // namespace
}  // namespace farlod::validation
