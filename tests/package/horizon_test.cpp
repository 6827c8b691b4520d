// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "base/azimuth.hpp"
#include "package/far_map.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Point2d unit(double azimuth_rad) { return {std::cos(azimuth_rad), std::sin(azimuth_rad)}; }

TEST(AzimuthBins, HoldTheAzimuthsBetweenTheirBorders) {
  for (const std::uint32_t count : {1U, 3U, 64U, 257U}) {
    const AzimuthBins bins{count};
    for (std::uint32_t k = 0; k < count; ++k)
      for (const double within : {0.01, 0.5, 0.99}) EXPECT_EQ(bins.bin_of(unit((k + within) * bins.width_rad())), k);
  }
}

TEST(AzimuthBins, BeginAtTheXAxisAndRunCounterClockwise) {
  const AzimuthBins bins{4};
  EXPECT_EQ(bins.bin_of({1.0, 0.0}), 0U);
  EXPECT_EQ(bins.bin_of({1.0, 1.0}), 0U);
  EXPECT_EQ(bins.bin_of({-1.0, 1.0}), 1U);
  EXPECT_EQ(bins.bin_of({-1.0, -1.0}), 2U);
  EXPECT_EQ(bins.bin_of({1.0, -1.0}), 3U);
}

TEST(AzimuthBins, WrapAnyNumberOfTurns) {
  const AzimuthBins bins{64};
  for (std::int64_t turn = -3; turn <= 3; ++turn)
    for (const std::int64_t bin : {0, 1, 31, 63}) EXPECT_EQ(bins.wrapped(bin + 64 * turn), bin);
}

TEST(PseudoAngle, CountsTurns) {
  EXPECT_EQ(pseudo_angle({7.0, 0.0}), 0.0);
  EXPECT_EQ(pseudo_angle({0.0, 0.1}), 0.25);
  EXPECT_EQ(pseudo_angle({-3.0, 0.0}), 0.5);
  EXPECT_EQ(pseudo_angle({0.0, -2.0}), 0.75);
  EXPECT_EQ(pseudo_angle({2.0, 2.0}), 0.125);
  EXPECT_EQ(pseudo_angle({2.0, -2.0}), 0.875);
}

TEST(PseudoAngle, GrowsByAnEighthToAQuarterOfATurnPerRadian) {
  constexpr int steps = 5000;
  constexpr double step_rad = 2.0 * pi / steps;
  // Each of the two values is the sum of a few roundings, none of a number above 1
  constexpr double rounding = 8 * epsilon;
  for (int n = 0; n + 1 < steps; ++n) {
    const double growth = pseudo_angle(unit((n + 1) * step_rad)) - pseudo_angle(unit(n * step_rad));
    EXPECT_GE(growth, 0.125 * step_rad - rounding) << n;
    EXPECT_LE(growth, 0.25 * step_rad + rounding) << n;
  }
}

TEST(PseudoAngle, DoesNotDependOnTheLength) {
  for (const double length : {1e-6, 1.0, 3e5})
    EXPECT_NEAR(pseudo_angle(length * Point2d{-0.6, 0.8}), pseudo_angle({-0.6, 0.8}), 4 * epsilon);
}

TEST(EdgeView, TurnsCounterClockwiseForPositive) {
  EXPECT_GT((EdgeView{{10.0, -1.0, 5.0}, {10.0, 1.0, 5.0}}.turn()), 0.0);
  EXPECT_LT((EdgeView{{10.0, 1.0, 5.0}, {10.0, -1.0, 5.0}}.turn()), 0.0);
  EXPECT_EQ((EdgeView{{10.0, 5.0, 5.0}, {20.0, 10.0, 7.0}}.turn()), 0.0);
}

TEST(SlopePlane, PassesThroughTheEyeAndEachPlaceOfTheEdge) {
  std::mt19937_64 random(20120901);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int n = 0; n < 1000; ++n) {
    const auto corner = [&] { return Point3d{between(-90, 90), between(-90, 90), between(-30, 200)}; };
    const EdgeView edge{corner(), corner()};
    const SlopePlane plane = edge.plane();
    // A determinant of lengths below 128 and 200 over one of lengths below 128, each with a handful of roundings
    const double rounding = 16 * 128 * 256 * epsilon / std::abs(edge.turn());
    for (const double t : {0.0, 0.3, 1.0}) {
      const Point3d p = (1.0 - t) * edge.a + t * edge.b;
      const double distance_m = norm(horizontal(p));
      if (distance_m < 1.0) continue;
      const Point2d u = (1.0 / distance_m) * horizontal(p);
      EXPECT_NEAR(plane.slope(u), p.z / distance_m, rounding * (1.0 + std::abs(p.z / distance_m))) << n << ", " << t;
    }
  }
}

TEST(SlopePlane, DoesNotDependOnTheOrderOfTheEnds) {
  const EdgeView edge{{40.0, -3.0, 12.0}, {31.0, 26.0, 20.0}}, other{edge.b, edge.a};
  EXPECT_DOUBLE_EQ(edge.plane().along_x, other.plane().along_x);
  EXPECT_DOUBLE_EQ(edge.plane().along_y, other.plane().along_y);
}

/// Square and oblong texels, maps of one texel a side, a hamlet's map and a map beside a tower.
constexpr BoxMap shapes[] = {{64, 64, 1.0F}, {1, 1, 0.3F}, {7, 5, 11.43F}, {3, 200, 100.0F}, {200, 3, 1e-4F}, {256, 256, 0.2F}};

TEST(BoxMap, TexelOfIsTheInverseOfDirectionOf) {
  for (const BoxMap& map : shapes)
    for (std::uint32_t row = 0; row < map.rows; ++row)
      for (std::uint32_t column = 0; column < map.columns(); ++column) {
        const Texel texel{column, row};
        ASSERT_EQ(map.texel_of(map.direction_of(texel)), texel) << "row " << row << ", column " << column;
      }
}

TEST(BoxMap, EveryDirectionOfATexelIsWithinHalfATexelOfItsMiddle) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  for (const BoxMap& map : shapes)
    for (int step = 0; step < 20000; ++step) {
      const double azimuth = 2.0 * std::numbers::pi * step / 20000;
      const double reach = std::max(std::abs(std::sin(azimuth)), std::abs(std::cos(azimuth)));
      const double up = static_cast<double>(map.top) * std::fmod(step * std::numbers::phi, 1.0);
      const Point3d d{std::sin(azimuth) / reach, std::cos(azimuth) / reach, up};
      const auto texel = map.texel_of(d);
      ASSERT_TRUE(texel);
      const Point3d middle = map.direction_of(*texel);
      EXPECT_LE(std::max(std::abs(d.x - middle.x), std::abs(d.y - middle.y)), 1.0 / map.side_columns + rounding);
      EXPECT_LE(std::abs(d.z - middle.z), map.top * (0.5 / map.rows + rounding));
    }
}

TEST(BoxMap, LengthDoesNotMatter) {
  for (const BoxMap& map : shapes) {
    const Texel texel{map.columns() - 1, map.rows - 1};
    for (const double length : {0.125, 8.0, 1024.0}) EXPECT_EQ(map.texel_of(length * map.direction_of(texel)), texel);
  }
}

TEST(BoxMap, TheBoxHasNoLidAndNoFloor) {
  for (const BoxMap& map : shapes) {
    const double top = map.top, below_top = std::nextafter(top, 0.0);
    for (const Point2d side : {Point2d{1, 0.3}, {-0.3, 1}, {-1, -0.3}, {0.3, -1}}) {
      EXPECT_EQ(map.texel_of({side.x, side.y, top}), std::nullopt);
      EXPECT_EQ(map.texel_of({side.x, side.y, -1e-300}), std::nullopt);
      ASSERT_TRUE(map.texel_of({side.x, side.y, below_top}));
      EXPECT_EQ(map.texel_of({side.x, side.y, below_top})->row, map.rows - 1);
      ASSERT_TRUE(map.texel_of({side.x, side.y, 0.0}));
      EXPECT_EQ(map.texel_of({side.x, side.y, 0.0})->row, 0U);
    }
    EXPECT_EQ(map.texel_of({0.0, 0.0, 1.0}), std::nullopt);
    EXPECT_EQ(map.texel_of({0.0, 0.0, -1.0}), std::nullopt);
    EXPECT_EQ(map.texel_of({0.0, 0.0, 0.0}), std::nullopt);
  }
}

TEST(BoxMap, TheSidesAreEastNorthWestSouth) {
  constexpr BoxMap map{10, 4, 1.0F};
  const auto side_of = [&](double x, double y) { return map.texel_of({x, y, 0.1})->column / map.side_columns; };
  EXPECT_EQ(side_of(1, 0), static_cast<std::uint32_t>(BoxSide::east));
  EXPECT_EQ(side_of(0, 1), static_cast<std::uint32_t>(BoxSide::north));
  EXPECT_EQ(side_of(-1, 0), static_cast<std::uint32_t>(BoxSide::west));
  EXPECT_EQ(side_of(0, -1), static_cast<std::uint32_t>(BoxSide::south));
}

TEST(BoxMap, TheVerticalEdgesBelongToEastAndWest) {
  constexpr BoxMap map{10, 4, 1.0F};
  EXPECT_EQ(map.texel_of({1, -1, 0.1})->column, 0U);    // first of the east side
  EXPECT_EQ(map.texel_of({1, 1, 0.1})->column, 9U);     // its last
  EXPECT_EQ(map.texel_of({-1, 1, 0.1})->column, 20U);   // first of the west side
  EXPECT_EQ(map.texel_of({-1, -1, 0.1})->column, 29U);  // its last
}

TEST(BoxMap, ColumnsRunCounterClockwiseFromTheSouthEast) {
  constexpr BoxMap map{10, 4, 1.0F};
  std::uint32_t before = 0;
  for (int step = 1; step < 1000; ++step) {
    const double turned = 2.0 * std::numbers::pi * (step / 1000.0 - 0.125);
    const std::uint32_t column = map.texel_of({std::cos(turned), std::sin(turned), 0.1})->column;
    EXPECT_TRUE(column == before || column == before + 1) << "column " << column << " follows " << before;
    before = column;
  }
  EXPECT_EQ(before, map.columns() - 1);
}

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Squares of 10 m, layers from −2 m.
ReceiverPatches two_by_two() { return {20.0, 2, {-2.0F, 3.0F, 9.5F}}; }

bool holds(const PatchBox& box, const Point3f& p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.z_low_m &&
         p.z <= box.z_high_m;
}

TEST(ReceiverPatches, EachPlaceLiesInTheBoxOfItsPatch) {
  const ReceiverPatches patches = two_by_two();
  std::set<std::uint32_t> met;
  for (float x = 0.0F; x <= 20.0F; x += 2.5F)
    for (float y = 0.0F; y <= 20.0F; y += 2.5F)
      for (const float z : {-2.0F, 0.0F, 2.9F, 3.0F, 9.49F, 9.5F, 400.0F}) {
        const auto patch = patches.patch_of({x, y, z});
        ASSERT_TRUE(patch);
        EXPECT_TRUE(holds(patches.box(*patch), {x, y, z})) << x << ", " << y << ", " << z;
        met.insert(*patch);
      }
  EXPECT_EQ(met.size(), patches.count());
  EXPECT_EQ(*met.rbegin(), patches.count() - 1);
}

TEST(ReceiverPatches, BelowTheLowestLevelThereIsNone) {
  EXPECT_FALSE(two_by_two().patch_of({5.0F, 5.0F, std::nextafter(-2.0F, -infinite)}));
  EXPECT_FALSE(two_by_two().patch_of({5.0F, 5.0F, std::numeric_limits<float>::quiet_NaN()}));
  EXPECT_TRUE(two_by_two().patch_of({5.0F, 5.0F, -2.0F}));
}

TEST(ReceiverPatches, TheUppermostLayerHasNoLid) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.ceiling_m(0), 3.0);
  EXPECT_EQ(patches.ceiling_m(2), std::numeric_limits<double>::infinity());
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 1e6F}), patches.number(0, 2));
}

TEST(ReceiverPatches, AreNumberedFromTheSouthWestAndLayerByLayer) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.patch_of({1.0F, 1.0F, 0.0F}), 0U);
  EXPECT_EQ(patches.patch_of({19.0F, 1.0F, 0.0F}), 1U);
  EXPECT_EQ(patches.patch_of({1.0F, 19.0F, 0.0F}), 2U);
  EXPECT_EQ(patches.patch_of({1.0F, 1.0F, 5.0F}), 4U);
}

TEST(ReceiverPatches, ABorderBelongsToTheEastAndTheNorth) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.patch_of({10.0F, 0.0F, 0.0F}), 1U);
  EXPECT_EQ(patches.patch_of({0.0F, 10.0F, 0.0F}), 2U);
  EXPECT_EQ(patches.patch_of({std::nextafter(10.0F, 0.0F), 0.0F, 0.0F}), 0U);
}

TEST(ReceiverPatches, WhatIsRoundedOutOfTheCellStaysInIt) {
  const ReceiverPatches patches = two_by_two();
  EXPECT_EQ(patches.patch_of({20.0F, 20.0F, 0.0F}), 3U);
  EXPECT_EQ(patches.patch_of({-1e-6F, -1e-6F, 0.0F}), 0U);
}

TEST(ReceiverPatches, LayersWithoutThicknessHoldNothing) {
  const ReceiverPatches patches(20.0, 1, {0.0F, 2.0F, 2.0F, 2.0F, 7.0F});
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 1.0F}), 0U);
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 2.0F}), 3U);
  EXPECT_EQ(patches.patch_of({5.0F, 5.0F, 7.0F}), 4U);
  // All at one height: a flat, empty cell
  EXPECT_EQ(ReceiverPatches(20.0, 1, {0.0F, 0.0F}).patch_of({5.0F, 5.0F, 0.0F}), 1U);
}

}  // namespace
}  // namespace farlod
