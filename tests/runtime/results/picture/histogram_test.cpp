// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "results/picture/drawing.hpp"
#include "results/picture/picture.hpp"
#include "tests/runtime/results/picture/decoded_png.hpp"

namespace farlod {
namespace {

/// Half of the width of the bins that a value is counted in.
constexpr double half_a_bin = 0.5e-4, arithmetic_error = 1e-9;

TEST(ValueCounts, KnowMeanAndQuartiles) {
  ValueCounts counts;
  for (int n = 0; n <= 100; ++n) counts.add(n / 100.0);
  counts.add(NAN);
  EXPECT_EQ(counts.count(), 101U);
  EXPECT_NEAR(*counts.mean(), 0.5, arithmetic_error);
  EXPECT_NEAR(*counts.quantile(0.25), 0.25, 2.0 * half_a_bin);
  EXPECT_NEAR(*counts.quantile(0.5), 0.5, 2.0 * half_a_bin);
  EXPECT_NEAR(*counts.quantile(1.0), 1.0, half_a_bin + arithmetic_error);
}

TEST(ValueCounts, WeighValues) {
  ValueCounts counts;
  counts.add(0.1, 3.0);
  counts.add(0.9, 1.0);
  EXPECT_NEAR(*counts.mean(), 0.3, arithmetic_error);
  EXPECT_NEAR(*counts.quantile(0.5), 0.1, 2.0 * half_a_bin);
  EXPECT_NEAR(*counts.quantile(0.9), 0.9, 2.0 * half_a_bin);
  const std::vector<double> shares = counts.shares(10);
  EXPECT_NEAR(shares[1], 0.75, arithmetic_error);
  EXPECT_NEAR(shares[9], 0.25, arithmetic_error);
}

TEST(ValueCounts, EndsBelongToTheLastBins) {
  ValueCounts counts;
  counts.add(0.0);
  counts.add(1.0);
  counts.add(1.0);
  EXPECT_NEAR(counts.shares(50)[0], 1.0 / 3.0, arithmetic_error);
  EXPECT_NEAR(counts.shares(50)[49], 2.0 / 3.0, arithmetic_error);
}

/// The range is doubled until all values are in it, and what was counted before stays where it was.
TEST(ValueCounts, CountFromZeroToAnyValue) {
  ValueCounts counts(CountedRange::from_zero);
  for (int n = 1; n <= 1300; ++n) counts.add(n);
  EXPECT_EQ(counts.largest(), 1300.0);
  EXPECT_NEAR(counts.mean().value(), 650.5, 1e-9);
  EXPECT_NEAR(counts.quantile(0.5).value(), 650.0, 0.2);
  for (const double share : counts.shares(50, 1300.0)) EXPECT_NEAR(share, 0.02, 1.5 / 1300.0);
}

TEST(ValueCounts, OfNothingAreNothing) {
  const ValueCounts counts;
  EXPECT_FALSE(counts.mean());
  EXPECT_FALSE(counts.quantile(0.5));
  EXPECT_EQ(counts.shares(50)[0], 0.0);
}

TEST(Histogram, BarsAreAsHighAsTheirShares) {
  // 40 % in the bin from .1 to .12, 10 % in that from .9 to .92, of roofs; all walls in one
  std::vector<HistogramSeries> series{{"roofs", "10 m²", ValueCounts()}, {"walls", "1 m²", ValueCounts()}};
  series[0].counts.add(0.11, 4.0);
  series[0].counts.add(0.91, 1.0);
  series[0].counts.add(0.51, 5.0);
  series[1].counts.add(0.11, 0.25);
  series[1].counts.add(0.31, 0.75);
  const double highest = highest_share(series);
  ASSERT_DOUBLE_EQ(highest, 0.8);
  const Picture picture = drawn(draw_histogram(series, {"svf", "Share of the area"}));
  const auto at = [&](double value, double share) {
    const PagePoint p = histogram_point(value, share, highest);
    return picture.at({static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y)});
  };
  // Bars of roofs are in the left half of their bins, and those of walls in the right one
  EXPECT_EQ(at(0.107, 0.38), colour_of_series(0));
  EXPECT_EQ(at(0.107, 0.43), (Colour{255, 255, 255}));
  EXPECT_EQ(at(0.113, 0.23), colour_of_series(1));
  EXPECT_EQ(at(0.113, 0.27), (Colour{255, 255, 255}));
  EXPECT_EQ(at(0.907, 0.08), colour_of_series(0));
  EXPECT_EQ(at(0.907, 0.12), (Colour{255, 255, 255}));
  EXPECT_EQ(at(0.313, 0.73), colour_of_series(1));
}

TEST(Histogram, TheAxisEndsNearItsTallestBar) {
  const auto highest = [](double share) {
    std::vector<HistogramSeries> series{{"pixels", "100", ValueCounts()}};
    series[0].counts.add(0.11, share);
    for (int n = 0; n < 40; ++n) series[0].counts.add(0.2 + 0.02 * n, (1.0 - share) / 40.0);
    return highest_share(series);
  };
  EXPECT_DOUBLE_EQ(highest(0.21), 0.25);
  EXPECT_DOUBLE_EQ(highest(0.41), 0.5);
  EXPECT_DOUBLE_EQ(highest(0.06), 0.06);
  EXPECT_DOUBLE_EQ(highest(1.0), 1.0);
}

TEST(Histogram, OfNoValuesIsDrawn) {
  const std::vector<HistogramSeries> series{{"pixels", "0", ValueCounts()}};
  EXPECT_EQ(drawn(draw_histogram(series, {"svf", ""})).size(), (PixelSize{900, 680}));
}

}  // namespace
}  // namespace farlod
