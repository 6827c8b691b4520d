// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/roff_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace farlod {
namespace {

TEST(RoffText, NothingIsACommand) {
  EXPECT_EQ(roff_paragraph(".SH is no heading"), "\\&.SH is no heading\n");
  EXPECT_EQ(roff_paragraph("in .zip and 'so'"), "in \\&.zip and \\&'so'\n");
  EXPECT_EQ(roff_paragraph("a\\fBb \"c\""), "a\\(rsfBb \\(dqc\\(dq\n");
  EXPECT_EQ(roff_literal(".a 'b' \\c"), "\\&.a \\(aqb\\(aq \\(rsc");
}

TEST(RoffText, IsAscii) {
  EXPECT_EQ(roff_paragraph("a — b…°"), "a \\[u2014] b\\[u2026]\\[u00B0]\n");
  EXPECT_EQ(roff_literal("😀"), "\\[u1F600]");
  const std::string roff = roff_paragraph("\xC3 and \xFF cut");
  EXPECT_TRUE(std::ranges::all_of(roff, [](char c) { return static_cast<unsigned char>(c) < 0x80; })) << roff;
}

TEST(RoffText, NamesOfOptionsAndProgramsAreBoldAndCanBeCopied) {
  EXPECT_EQ(roff_paragraph("(not for --on-surface, nor -o)"), "(not for \\fB\\-\\-on\\-surface\\fR, nor \\fB\\-o\\fR)\n");
  EXPECT_EQ(roff_paragraph("farlod-pack"), "\\fBfarlod\\-pack\\fR\n");
  EXPECT_EQ(roff_paragraph("the no-data value of -10"), "the no-data value of \\-10\n");
  EXPECT_EQ(roff_literal("farlod-svf --at 1,2"), "farlod\\-svf \\-\\-at 1,2");
}

TEST(RoffText, ASentenceBeginsALine) {
  EXPECT_EQ(roff_paragraph("One. Two (three.) Four? Five"), "One.\nTwo (three.)\nFour?\nFive\n");
  EXPECT_EQ(roff_paragraph("  CityGML 1.0\n to 3.0 "), "CityGML 1.0 to 3.0\n");
}

TEST(RoffText, LinesAreShort) {
  std::string text;
  for (int n = 0; n < 100; ++n) text += "word" + std::to_string(n) + " ";
  std::istringstream lines(roff_paragraph(text));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U);
  const std::string long_word(90, 'w');
  EXPECT_EQ(roff_paragraph("a " + long_word + " b"), "a\n" + long_word + "\nb\n");
}

}  // namespace
}  // namespace farlod
