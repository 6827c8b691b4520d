// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "horizon/kernels.hpp"
#include "horizon/pixel_field.hpp"
#include "horizon/pixel_march.hpp"
#include "package/pixel_heights.hpp"
#include "package/pixel_middle.hpp"

namespace farlod {
namespace {

constexpr double pixel_edge_m = 2.0;

/// A raster, of which each two pixels beside each other are joined that differ by no more than a step.
struct Pixels {
  std::int32_t columns, rows;
  std::vector<float> height_m;
  std::vector<std::uint8_t> joined;

  Pixels(std::int32_t c, std::int32_t r, double step_m, const std::function<double(std::int32_t, std::int32_t)>& height)
      : columns(c), rows(r) {
    for (std::int32_t y = 0; y < rows; ++y)
      for (std::int32_t x = 0; x < columns; ++x) height_m.push_back(static_cast<float>(height(x, y)));
    for (std::int32_t y = 0; y < rows; ++y)
      for (std::int32_t x = 0; x < columns; ++x) {
        const auto is_joined = [&](std::int32_t east, std::int32_t north) {
          return x + east < columns && y + north < rows && std::abs(at(x, y) - at(x + east, y + north)) <= step_m;
        };
        joined.push_back(
            static_cast<std::uint8_t>((is_joined(1, 0) ? JoinedPixels::east : 0) | (is_joined(0, 1) ? JoinedPixels::north : 0)));
      }
  }
  [[nodiscard]] double at(std::int32_t x, std::int32_t y) const {
    return static_cast<double>(height_m[static_cast<std::size_t>(y * columns + x)]);
  }
  [[nodiscard]] PixelField field() const {
    package::SurfacePixels pixels;
    pixels.step_m = pixel_edge_m;
    pixels.columns = static_cast<std::uint32_t>(columns);
    pixels.rows = static_cast<std::uint32_t>(rows);
    return {pixels, height_m, joined};
  }
};

/// The height of the surface at a place, counted in pixels from the centre of the first: triangle by triangle, as a raster's
/// surface is defined (docs/concepts.md). The lowest number there is where it has none.
class Judge {
 public:
  explicit Judge(const PixelField& field) : field_(field) {}

  [[nodiscard]] double height_at(double x, double y) const {
    const auto column = static_cast<std::int32_t>(std::floor(x)), row = static_cast<std::int32_t>(std::floor(y));
    const FourPixels four = field_.four_from(column, row);
    const double u = x - column, v = y - row;
    return four.is_whole() ? whole(four, u, v) : torn(four, u, v);
  }

 private:
  static constexpr double nowhere = std::numeric_limits<double>::lowest();

  /// Of the plane through three corners of the unit square, the middle of which is at the right angle.
  static double whole(const FourPixels& four, double u, double v) {
    const auto& h = four.height_m;
    if (four.fold() == 0)
      return v <= u ? h[0] + u * (h[1] - h[0]) + v * (h[2] - h[1]) : h[0] + v * (h[3] - h[0]) + u * (h[2] - h[3]);
    return u + v <= 1.0 ? h[0] + u * (h[1] - h[0]) + v * (h[3] - h[0])
                        : h[2] + (1.0 - u) * (h[3] - h[2]) + (1.0 - v) * (h[1] - h[2]);
  }
  /// The triangle from the middle to the centre of the pixel that holds the place, on this side of the diagonal; its third corner
  /// is the next pixel's centre, or lies half-way to it as high as the pixel's own.
  static double torn(const FourPixels& four, double u, double v) {
    const std::size_t k = v < 0.5 ? (u < 0.5 ? 0 : 1) : (u < 0.5 ? 3 : 2);
    if (!four.has_height[k]) return nowhere;
    const double middle = middle_of(four).middle_height_m[k], own = four.height_m[k];
    // From the centre: along x and along y, to 0.5 at the sides of the pixel
    const double along_x = u < 0.5 ? u : 1.0 - u, along_y = v < 0.5 ? v : 1.0 - v;
    const std::size_t side_x = v < 0.5 ? 0 : 2, side_y = u < 0.5 ? 3 : 1;
    const std::size_t beside_x = (k == 0 || k == 3) ? (k == 0 ? 1 : 2) : (k == 1 ? 0 : 3),
                      beside_y = (k == 0 || k == 1) ? (k == 0 ? 3 : 2) : (k == 2 ? 1 : 0);
    const auto at_side = [&](std::size_t side, std::size_t beside) {
      return four.joined[side] ? 0.5 * (own + four.height_m[beside]) : own;
    };
    const double to_x = at_side(side_x, beside_x) - own, to_y = at_side(side_y, beside_y) - own;
    return along_x >= along_y ? own + 2.0 * ((along_x - along_y) * to_x + along_y * (middle - own))
                              : own + 2.0 * ((along_y - along_x) * to_y + along_x * (middle - own));
  }

  const PixelField& field_;
};

/// Horizons of the pixels of a block, by all targets: rows of a block, [azimuth][pixel].
struct Marched {
  std::vector<PixelBlock> blocks;
  std::vector<std::vector<float>> slopes;
};
Marched march(const PixelKernels& kernels, const PixelField& field, std::span<const Point2d> directions, std::int32_t column,
              std::int32_t row, double above_m, const PixelOffset& offset = {}, std::size_t step = 1) {
  const PixelPaths paths(directions, field, offset);
  const Judge judge(field);
  const Point2d place = offset.in_pixels();
  PixelWindow window(field);
  window.look_at(column, row);
  Marched m;
  PixelBlock block{};
  block.window_x = window.x_of(column);
  block.window_y = window.y_of(row);
  block.column = column;
  block.row = row;
  for (std::int32_t r = 0; r < static_cast<std::int32_t>(PixelBlock::rows); ++r) {
    m.slopes.emplace_back(directions.size() * packet_lanes);
    for (std::int32_t l = 0; l < static_cast<std::int32_t>(packet_lanes); ++l)
      block.z_m[r][l] = field.contains(column + l, row + r)
                            ? static_cast<float>(judge.height_at(column + l + place.x, row + r + place.y) + above_m)
                            : PixelBlock::no_receiver_m;
  }
  for (std::size_t r = 0; r < PixelBlock::rows; ++r) block.slopes[r] = m.slopes[r].data();
  m.blocks.push_back(block);
  kernels.march(window.view(), field.view(), paths.paths(), m.blocks, step);
  return m;
}

std::vector<Point2d> directions_around(std::size_t count, double first_rad) {
  std::vector<Point2d> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const double azimuth = first_rad + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    directions.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
  return directions;
}

/// The largest slope to what a ray passes. Between two steps of it, a surface that rises by 12 m from pixel to pixel rises by
/// less than judged_within of its distance.
constexpr double judged_within = 12.0 / pixel_edge_m * 5e-5;
double judged_slope(const Judge& judge, Point2d from, double z_m, Point2d direction, double reach) {
  double slope = 0.0;
  for (double s = 1e-2; s < reach; s *= 1.00005)
    slope = std::max(slope, (judge.height_at(from.x + s * direction.x, from.y + s * direction.y) - z_m) / (s * pixel_edge_m));
  return slope;
}

/// From these pixels, at an offset in each; of the azimuths, the first is that of an axis.
void expect_as_judged(const Pixels& pixels, std::int32_t column, std::int32_t row, const PixelOffset& offset = {}) {
  const PixelField field = pixels.field();
  const Judge judge(field);
  std::vector<Point2d> directions = directions_around(12, 0.1);
  directions.insert(directions.begin(), {1.0, 0.0});
  const Marched marched = march(pixel_kernels(), field, directions, column, row, 1.5, offset);
  const Point2d place = offset.in_pixels();
  for (std::int32_t r = 0; r < 4; r += 3)
    for (std::int32_t l = 0; l < 16; l += 5)
      for (std::size_t k = 0; k < directions.size(); ++k) {
        const double z_m = static_cast<double>(marched.blocks[0].z_m[r][l]);
        const double expected = judged_slope(judge, {column + l + place.x, row + r + place.y}, z_m, directions[k],
                                             std::hypot(pixels.columns, pixels.rows));
        const double found =
            static_cast<double>(marched.slopes[static_cast<std::size_t>(r)][k * packet_lanes + static_cast<std::size_t>(l)]);
        EXPECT_NEAR(found, expected, judged_within + 1e-4 * expected) << column + l << ',' << row + r << " azimuth " << k;
      }
}

Pixels random_pixels(std::int32_t edge, double step_m, double rise_m, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> rise(0.0, rise_m), part(0.0, 1.0);
  return {edge, edge, step_m, [&](std::int32_t, std::int32_t) { return part(random) < 0.2 ? 3.0 * rise(random) : rise(random); }};
}

TEST(PixelMarch, SeesASlopeAsItIs) { expect_as_judged(random_pixels(28, 1e9, 4.0, 1), 6, 12); }

TEST(PixelMarch, SeesWallsAndSlopesAsTheyAre) {
  expect_as_judged(random_pixels(28, 2.0, 4.0, 2), 6, 12);
  expect_as_judged(random_pixels(28, 3.5, 4.0, 3), 6, 12);
}

Pixels town_around_a_square() {
  std::mt19937 random(4);
  std::vector<double> blocks;
  for (int n = 0; n < 40 * 40; ++n) blocks.push_back(random() % 4 == 0 ? 10.0 + static_cast<double>(random() % 60) : 0.0);
  // An open place around the receivers, so that what is far is seen
  return {200, 200, 2.0, [&](std::int32_t x, std::int32_t y) {
            return std::hypot(x - 100, y - 100) < 45.0 ? 0.0 : blocks[static_cast<std::size_t>(y / 5 * 40 + x / 5)];
          }};
}

TEST(PixelMarch, SeesALevelTownAsItIsHoweverFar) { expect_as_judged(town_around_a_square(), 96, 98); }

TEST(PixelMarch, SeesTheSameFromAnyPlaceInAPixel) {
  // A corner and a side of pixels, where no wall may stand, and places that are neither
  for (const PixelOffset& offset : {PixelOffset{4096, 4096}, PixelOffset{-4096, 0}, PixelOffset{2048, -2048}}) {
    SCOPED_TRACE(testing::Message() << offset.east << ',' << offset.north);
    expect_as_judged(random_pixels(28, 1e9, 4.0, 1), 6, 12, offset);
  }
  for (const PixelOffset& offset : {PixelOffset{1234, 3517}, PixelOffset{-2750, 41}}) {
    SCOPED_TRACE(testing::Message() << offset.east << ',' << offset.north);
    expect_as_judged(random_pixels(28, 3.5, 4.0, 3), 6, 12, offset);
    expect_as_judged(town_around_a_square(), 96, 98, offset);
  }
}

TEST(PixelMarch, SeesFarReliefWithinItsFolds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  const Pixels relief(160, 160, 1e9, [&](std::int32_t x, std::int32_t y) {
    return std::hypot(x - 80, y - 80) < 40.0 ? 0.0 : 40.0 * std::sin(0.08 * x) * std::cos(0.05 * y) + noise(random);
  });
  // Beyond the window a fold between four pixels is not seen: no more than a quarter of what they are out of a plane
  double fold_m = 0.0;
  for (std::int32_t y = 0; y + 1 < relief.rows; ++y)
    for (std::int32_t x = 0; x + 1 < relief.columns; ++x)
      fold_m = std::max(fold_m,
                        0.25 * std::abs(relief.at(x, y) + relief.at(x + 1, y + 1) - relief.at(x + 1, y) - relief.at(x, y + 1)));
  const PixelField field = relief.field();
  const Judge judge(field);
  const std::vector<Point2d> directions = directions_around(16, 0.2);
  const Marched marched = march(pixel_kernels(), field, directions, 76, 78, 1.5);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double expected = judged_slope(judge, {76.0, 78.0}, 1.5, directions[k], 230.0);
    EXPECT_NEAR(static_cast<double>(marched.slopes[0][k * packet_lanes]), expected,
                judged_within + fold_m / (pixel_reach * pixel_edge_m))
        << k;
  }
}

TEST(PixelMarch, AWallAroundASquareIsTheClosedForm) {
  // From the centre of a level court of 2a × 2a, the wall before (cos φ, sin φ) is a / max(|cos φ|, |sin φ|) away
  constexpr std::int32_t edge = 141, half = 20;
  constexpr double rise_m = 30.0;
  const Pixels court(edge, edge, 2.0, [&](std::int32_t x, std::int32_t y) {
    return std::max(std::abs(x - 70), std::abs(y - 70)) <= half ? 0.0 : rise_m;
  });
  const std::vector<Point2d> directions = directions_around(64, 0.03);
  const Marched marched = march(pixel_kernels(), court.field(), directions, 70, 70, 1.0);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double distance_m = (half + 0.5) * pixel_edge_m / std::max(std::abs(directions[k].x), std::abs(directions[k].y));
    EXPECT_NEAR(static_cast<double>(marched.slopes[0][k * packet_lanes]), (rise_m - 1.0) / distance_m, 1e-5) << k;
  }
}

TEST(PixelMarch, AllTargetsGiveTheSameBits) {
  for (const double step_m : {2.0, 1e9}) {
    const PixelField field = random_pixels(150, step_m, 6.0, 6).field();
    const std::vector<Point2d> directions = directions_around(48, 0.0);
    const Marched expected = march(pixel_kernels(), field, directions, 64, 64, 1.5);
    for (const KernelTarget& target : runnable_kernels())
      EXPECT_EQ(march(*target.pixel, field, directions, 64, 64, 1.5).slopes, expected.slopes) << target.name;
    const Marched stepped = march(pixel_kernels(), field, directions, 64, 64, 1.5, {}, 4);
    for (const KernelTarget& target : runnable_kernels())
      EXPECT_EQ(march(*target.pixel, field, directions, 64, 64, 1.5, {}, 4).slopes, stepped.slopes) << target.name;
  }
}

/// The mean of both neighbors where they are alike, and what the rays say elsewhere: of each receiver by itself.
TEST(PixelMarch, BetweenAzimuthsThatAreAlikeIsTheirMean) {
  const PixelField field = random_pixels(150, 1e9, 3.0, 8).field();
  const std::vector<Point2d> directions = directions_around(64, 0.05);
  const Marched all = march(pixel_kernels(), field, directions, 64, 64, 1.5),
                half = march(pixel_kernels(), field, directions, 64, 64, 1.5, {}, 2);
  std::size_t means = 0;
  for (std::size_t r = 0; r < PixelBlock::rows; ++r)
    for (std::size_t l = 0; l < packet_lanes; ++l)
      for (std::size_t k = 0; k < directions.size(); ++k) {
        const auto slope = [&, r = r, l = l](const Marched& marched, std::size_t n) {
          return marched.slopes[r][n % directions.size() * packet_lanes + l];
        };
        const float before = slope(all, k + directions.size() - 1), after = slope(all, k + 1);
        const bool is_mean = k % 2 == 1 && std::abs(before - after) <= level_slope;
        EXPECT_EQ(slope(half, k), is_mean ? 0.5F * (before + after) : slope(all, k)) << r << ' ' << l << ' ' << k;
        means += is_mean ? 1 : 0;
      }
  EXPECT_GT(means, 100U);
  EXPECT_LT(means, 2000U);
}

TEST(PixelMarch, WhatARowSeesDoesNotDependOnOthers) {
  const PixelField field = random_pixels(150, 2.0, 6.0, 7).field();
  const std::vector<Point2d> directions = directions_around(48, 0.05);
  const Marched together = march(pixel_kernels(), field, directions, 64, 64, 1.5);
  const PixelPaths paths(directions, field);
  PixelWindow window(field);
  window.look_at(64, 64);
  for (std::size_t r = 0; r < PixelBlock::rows; ++r) {
    PixelBlock alone = together.blocks[0];
    std::vector<float> slopes(directions.size() * packet_lanes);
    for (std::size_t other = 0; other < PixelBlock::rows; ++other) {
      alone.slopes[other] = other == r ? slopes.data() : nullptr;
      if (other != r) std::fill_n(alone.z_m[other], packet_lanes, PixelBlock::no_receiver_m);
    }
    pixel_kernels().march(window.view(), field.view(), paths.paths(), {&alone, 1}, 1);
    EXPECT_EQ(slopes, together.slopes[r]) << r;
  }
}

TEST(PixelMarch, NothingIsSeenBeyondARasterNorWhereItHasNoHeight) {
  const auto hole = [](std::int32_t x, std::int32_t y) {
    return x == 30 || y == 5 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  };
  const PixelField field = Pixels(70, 9, 2.0, hole).field();
  const std::vector<Point2d> directions = directions_around(32, 0.0);
  for (const std::int32_t column : {0, 32, 60}) {
    const Marched marched = march(pixel_kernels(), field, directions, column, 0, 0.5);
    for (std::size_t k = 0; k < directions.size(); ++k) EXPECT_EQ(marched.slopes[0][k * packet_lanes], 0.0F) << k;
  }
}

}  // namespace
}  // namespace farlod
