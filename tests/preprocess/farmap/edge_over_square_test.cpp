// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farmap/edge_over_square.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "farmap/bin_borders.hpp"
#include "tests/preprocess/farmap/sight.hpp"

namespace farlod {
namespace {

using test::Chance;

constexpr int trials = 4000;
const BinBorders coarse({64}), fine({256});

struct View {
  Box2d square;
  Point3d a, b;
};

Point2d at(double azimuth_rad, double distance_m) { return distance_m * Point2d{std::cos(azimuth_rad), std::sin(azimuth_rad)}; }

/// Squares here and there, some around the origin; edges near and far, short and long, level and sloped; some due west, where
/// azimuths wrap; some that a place of the square looks along.
View random_view(Chance& chance) {
  const double edge_m = chance.between(5.0, 60.0);
  const Point2d low = chance.below(2) == 0 ? Point2d{-0.5 * edge_m, -0.5 * edge_m}
                                           : Point2d{chance.between(-500, 500), chance.between(-500, 500)};
  const Box2d square{low, low + Point2d{edge_m, edge_m}};
  const Point2d place{chance.between(low.x, square.high.x), chance.between(low.y, square.high.y)};
  const double pi = std::numbers::pi, azimuth = chance.below(3) == 0 ? pi : chance.between(-pi, pi);
  const Point2d middle = place + at(azimuth, chance.between(edge_m, chance.below(2) == 0 ? 2.0 * edge_m : 800.0));
  const double direction = chance.below(4) == 0 ? azimuth + chance.between(-0.01, 0.01) : chance.between(-pi, pi);
  const Point2d half = at(direction, chance.between(0.05, chance.below(2) == 0 ? 2.0 : 150.0));
  const double z_m = chance.between(0.0, 100.0), rise_m = chance.below(2) == 0 ? 0.0 : chance.between(-30.0, 30.0);
  const Point2d a = middle - half, b = middle + half;
  return {square, {a.x, a.y, z_m}, {b.x, b.y, z_m + rise_m}};
}

/// The corners of a square, and places inside.
std::vector<Point2d> places_in(const Box2d& square, Chance& chance) {
  std::vector<Point2d> places{square.low, square.high, {square.low.x, square.high.y}, {square.high.x, square.low.y}};
  for (int n = 0; n < 8; ++n)
    places.push_back({chance.between(square.low.x, square.high.x), chance.between(square.low.y, square.high.y)});
  return places;
}

/// The place of a bin among those of an edge; none if it is not one of them.
std::optional<std::size_t> place_of(std::uint32_t bin, const EdgeOverSquare& edge, const AzimuthBins& bins) {
  for (std::size_t n = 0; n < edge.bin_count(); ++n)
    if (bins.wrapped(edge.first_bin() + static_cast<std::int64_t>(n)) == bin) return n;
  return std::nullopt;
}

void expect_below_high(const View& view, EdgeOverSquare& edge, const AzimuthBins& bins, double z_m, Chance& chance) {
  const std::span<const double> upper = edge.high(z_m);
  for (const Point2d place : places_in(view.square, chance)) {
    const Point3d eye{place.x, place.y, chance.below(2) == 0 ? z_m : z_m + chance.between(0.0, 40.0)};
    for (const double share : {0.0, 1.0, chance.between(0, 1), chance.between(0, 1), chance.between(0, 1)}) {
      const test::Sight sight = test::sight_of(test::point_between(view.a, view.b, share), eye, bins);
      const auto n = place_of(sight.bin, edge, bins);
      ASSERT_TRUE(n) << "seen in a bin that it should not touch";
      ASSERT_LE(sight.slope, upper[*n]);
    }
  }
}

/// Returns in how many bins something is promised.
int expect_above_low(const View& view, EdgeOverSquare& edge, const AzimuthBins& bins, double z_m, Chance& chance) {
  const std::span<const double> all = edge.low(z_m);
  int promises = 0;
  for (std::size_t n = 0; n < edge.bin_count(); ++n) {
    const double lower = all[n];
    if (lower == 0.0) continue;
    ++promises;
    for (const Point2d place : places_in(view.square, chance)) {
      const Point3d eye{place.x, place.y, chance.below(2) == 0 ? z_m : z_m - chance.between(0.0, 40.0)};
      for (const double share : {0.0, 1.0, chance.between(0, 1)}) {
        const auto slope = test::slope_at(
            (static_cast<double>(edge.first_bin()) + static_cast<double>(n) + share) * bins.width_rad(), view.a, view.b, eye);
        EXPECT_TRUE(slope) << "some eye looks past the edge in this bin";
        EXPECT_GE(slope.value_or(lower), lower);
      }
    }
  }
  return promises;
}

TEST(EdgeOverSquare, NoEyeSeesTheEdgeSteeperThanHigh) {
  Chance chance(1);
  int bounded = 0;
  for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const View view = random_view(chance);
    const BinBorders& borders = chance.below(2) == 0 ? coarse : fine;
    EdgeOverSquare edge(borders);
    edge.set_edge(view.a, view.b, view.square);
    const double z_m = chance.between(-5.0, 110.0);
    if (edge.is_unbounded()) continue;
    ++bounded;
    expect_below_high(view, edge, borders.bins(), z_m, chance);
  }
  EXPECT_GT(bounded, trials / 2);
}

TEST(EdgeOverSquare, EveryEyeSeesTheEdgeAtLeastAsSteepAsLowAllOverTheBin) {
  Chance chance(2);
  int promises = 0;
  for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const View view = random_view(chance);
    const BinBorders& borders = chance.below(2) == 0 ? coarse : fine;
    EdgeOverSquare edge(borders);
    edge.set_edge(view.a, view.b, view.square);
    if (!edge.is_unbounded()) promises += expect_above_low(view, edge, borders.bins(), chance.between(-5.0, 110.0), chance);
  }
  EXPECT_GT(promises, trials / 2);
}

TEST(EdgeOverSquare, NothingIsCertainOfAnEdgeThatAnEyeLooksAlong) {
  // The south side of the square lies in line with it: eyes there see it as a point
  EdgeOverSquare edge(fine);
  edge.set_edge({100, 0, 20}, {300, 0, 20}, {{0, 0}, {25, 25}});
  ASSERT_FALSE(edge.is_unbounded());
  for (std::size_t n = 0; n < edge.bin_count(); ++n) EXPECT_EQ(edge.low(0.0)[n], 0.0);
}

TEST(EdgeOverSquare, WhatIsNotAboveTheEyesHidesNothing) {
  EdgeOverSquare edge(fine);
  edge.set_edge({100, -50, 20}, {100, 50, 20}, {{0, 0}, {25, 25}});
  for (std::size_t n = 0; n < edge.bin_count(); ++n) {
    EXPECT_EQ(edge.high(20.0)[n], 0.0);
    EXPECT_EQ(edge.low(20.0)[n], 0.0);
    EXPECT_EQ(edge.low(std::numeric_limits<double>::infinity())[n], 0.0) << "a layer without a lid";
  }
}

TEST(EdgeOverSquare, BoundsOfABroadEdgeAreAsTightAsGeometryAllows) {
  // Due east, so broad that every eye sees it in the bins beside the x axis: nearest from x = 25, farthest from x = 0
  EdgeOverSquare edge(fine);
  edge.set_edge({100, -300, 30}, {100, 300, 30}, {{0, 0}, {25, 25}});
  for (const std::int64_t bin : {-1, 0}) {
    const auto n = static_cast<std::size_t>(bin - edge.first_bin());
    const double steepest = 30.0 / 75.0, flattest = 30.0 / 100.0 * std::cos(fine.bins().width_rad());
    EXPECT_NEAR(edge.high(0.0)[n], steepest, 1.001 * bound_rounding * (1.0 + steepest));
    EXPECT_NEAR(edge.low(0.0)[n], flattest, 1.001 * bound_rounding * (1.0 + flattest));
  }
}

bool surrounds(const Point3d& a, const Point3d& b, const Box2d& square) {
  EdgeOverSquare edge(fine);
  edge.set_edge(a, b, square);
  return edge.is_unbounded();
}

TEST(EdgeOverSquare, OnlyEdgesThatAreCloseSurround) {
  const Box2d square{{-10, -10}, {10, 10}};
  EXPECT_TRUE(surrounds({-50, 5, 9}, {50, 6, 9}, square)) << "it crosses the square";
  EXPECT_TRUE(surrounds({-2000, 11, 9}, {2000, 11, 9}, square)) << "it is seen over half a turn";
  EXPECT_TRUE(surrounds({10, 10, 9}, {30, 30, 9}, square)) << "it touches the square";
  EXPECT_FALSE(surrounds({30, -20, 9}, {30, 20, 9}, square));
}

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
