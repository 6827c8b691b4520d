// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/bin_borders.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/preprocess/farmap/sight.hpp"

namespace farlod {
namespace {

/// Directions whose azimuths differ by less than this from a border's may be on either side of it: cosines, sines and their
/// products are rounded a few times each.
constexpr double border_rounding_rad = 1e-15;

Point2d direction(double azimuth_rad, double length) { return {length * std::cos(azimuth_rad), length * std::sin(azimuth_rad)}; }

class EachBinCount : public testing::TestWithParam<std::uint32_t> {
 protected:
  const BinBorders borders{{GetParam()}};
  const AzimuthBins bins{GetParam()};
};

TEST_P(EachBinCount, ABinIsThatOfTheArcTangent) {
  test::Chance chance(7);
  for (int trial = 0; trial < 20000; ++trial) {
    const Point2d d = direction(chance.between(-std::numbers::pi, std::numbers::pi), chance.between(0.001, 1e5));
    ASSERT_EQ(bins.wrapped(borders.bin_of(d)), bins.bin_of(d)) << d.x << ", " << d.y;
  }
}

TEST_P(EachBinCount, BesideABorderItIsTheBinOnThatSide) {
  for (std::int64_t bin = 0; bin < bins.count; ++bin) {
    const double azimuth = static_cast<double>(bin) * bins.width_rad(), aside = 4.0 * border_rounding_rad * (1.0 + azimuth);
    EXPECT_EQ(bins.wrapped(borders.bin_of(direction(azimuth + aside, 1.0))), bin);
    EXPECT_EQ(bins.wrapped(borders.bin_of(direction(azimuth - aside, 1.0)) + 1), bin);
  }
}

TEST_P(EachBinCount, BinsLieWithinHalfATurn) {
  test::Chance chance(8);
  for (int trial = 0; trial < 20000; ++trial) {
    const std::int64_t bin = borders.bin_of(direction(chance.between(-4.0, 4.0), 10.0));
    ASSERT_GE(2 * bin, -std::int64_t{bins.count});
    ASSERT_LT(2 * bin, std::int64_t{bins.count});
  }
  EXPECT_EQ(borders.bin_of({1.0, 0.0}), 0);
  EXPECT_EQ(borders.bin_of({1.0, -1e-9}), -1);
}

TEST_P(EachBinCount, BetweenTwoDirectionsAreTheBinsCounterClockwise) {
  test::Chance chance(9);
  for (int trial = 0; trial < 20000; ++trial) {
    const double from = chance.between(-std::numbers::pi, std::numbers::pi), to = from + chance.between(0.0, 3.1);
    const BinRange range = borders.between(direction(from, 3.0), direction(to, 5.0));
    const auto counted_on = [this](double azimuth_rad) { return std::floor(azimuth_rad / bins.width_rad()); };
    ASSERT_EQ(range.count, static_cast<std::size_t>(counted_on(to) - counted_on(from)) + 1);
    ASSERT_EQ(bins.wrapped(range.first), bins.bin_of(direction(from, 3.0)));
  }
}

INSTANTIATE_TEST_SUITE_P(Bins, EachBinCount, testing::Values(3U, 7U, 8U, 64U, 256U, 1000U));

}  // namespace
}  // namespace farlod
