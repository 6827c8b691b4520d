// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/decimal.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace farlod {
namespace {

std::string millimetre_decimal(double value) {
  std::string text;
  append_millimetres(text, value);
  return text;
}

TEST(Decimal, ShortestReadsBackAsTheSame) {
  for (const double value : {0.1, 1.0 / 3.0, 5700010.123456789, -1e-7, 1e22, std::numeric_limits<double>::denorm_min()})
    EXPECT_EQ(std::strtod(shortest_decimal(value).c_str(), nullptr), value);
  EXPECT_EQ(shortest_decimal(0.1F), "0.1");
}

TEST(Decimal, HasNoExponentAndNoNegativeZero) {
  EXPECT_EQ(shortest_decimal(1e6), "1000000");
  EXPECT_EQ(shortest_decimal(-0.0), "0");
  EXPECT_EQ(millimetre_decimal(-0.0001), "0");
}

TEST(Decimal, LongestNumbersFit) {
  EXPECT_EQ(shortest_decimal(std::numeric_limits<double>::max()).size(), 309U);
  EXPECT_EQ(shortest_decimal(-std::numeric_limits<double>::denorm_min()).size(), 327U);
}

TEST(Decimal, CoordinatesEndAtTheMillimetre) {
  EXPECT_EQ(millimetre_decimal(5700010.123456), "5700010.123");
  EXPECT_EQ(millimetre_decimal(1.5), "1.5");
  EXPECT_EQ(millimetre_decimal(2.0), "2");
  EXPECT_EQ(millimetre_decimal(-0.05), "-0.05");
  EXPECT_EQ(millimetre_decimal(-12.345678), "-12.346");
  EXPECT_EQ(millimetre_decimal(999999999999.9995), "1000000000000");
  EXPECT_EQ(millimetre_decimal(1e15 + 0.25), "1000000000000000.2");
  EXPECT_EQ(millimetre_decimal(0.001), "0.001");
}

TEST(Decimal, SharesHaveSixDigits) {
  EXPECT_EQ(svf_decimal(1.0), "1.000000");
  EXPECT_EQ(svf_decimal(0.3390174), "0.339017");
}

}  // namespace
}  // namespace farlod
