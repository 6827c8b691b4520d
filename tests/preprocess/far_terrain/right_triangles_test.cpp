// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "far_terrain/right_triangles.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

namespace farlod::far_terrain {
namespace {

constexpr std::uint32_t side = 32, along = side + 1;

std::vector<float> rough_heights(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<float> height_m(along * along);
  for (std::uint32_t n = 0; n < height_m.size(); ++n) {
    const auto x = static_cast<float>(n % along), y = static_cast<float>(n / along);
    height_m[n] = 10.0F * std::sin(0.2F * x) * std::cos(0.13F * y) + static_cast<float>(random() % 1000) * 1e-3F;
  }
  return height_m;
}

/// The height of a triangle over a node, counted in nodes; none where it does not cover it.
std::optional<double> height_over(const Triangle& t, const std::vector<float>& height_m, std::uint32_t node) {
  const auto place = [](std::uint32_t n) { return std::array{static_cast<double>(n % along), static_cast<double>(n / along)}; };
  const auto cross = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto [ax, ay] = place(a);
    const auto [bx, by] = place(b);
    const auto [cx, cy] = place(c);
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  };
  const double all = cross(t.a, t.b, t.c), a = cross(node, t.b, t.c) / all, b = cross(t.a, node, t.c) / all, c = 1.0 - a - b;
  if (std::min({a, b, c}) < -1e-12) return std::nullopt;
  return a * height_m[t.a] + b * height_m[t.b] + c * height_m[t.c];
}

TEST(RightTriangles, NoNodeIsOffByMuchMoreThanItsTolerance) {
  for (const float tolerance_m : {0.0F, 0.3F, 1.0F, 5.0F, 100.0F}) {
    const std::vector<float> height_m = rough_heights(7), tolerances(height_m.size(), std::max(tolerance_m, 1e-9F));
    const std::vector<Triangle> triangles = RightTriangles(side).triangulate({height_m, tolerances});
    EXPECT_LE(triangles.size(), 2U * side * side);
    for (std::uint32_t node = 0; node < height_m.size(); ++node) {
      bool is_covered = false;
      for (const Triangle& t : triangles)
        if (const auto over_m = height_over(t, height_m, node)) {
          is_covered = true;
          EXPECT_NEAR(*over_m, height_m[node], 1.5F * tolerance_m + 1e-4F) << node;
        }
      EXPECT_TRUE(is_covered) << node;
    }
    if (tolerance_m == 100.0F) {
      EXPECT_EQ(triangles.size(), 2U);
    }
  }
}

TEST(RightTriangles, AreSmallOnlyWhereTheToleranceIs) {
  const std::vector<float> height_m = rough_heights(8);
  std::vector<float> tolerances(height_m.size(), 100.0F);
  for (std::uint32_t n = 0; n < along * 4; ++n) tolerances[n] = 1e-3F;
  const std::size_t few = RightTriangles(side).triangulate({height_m, tolerances}).size();
  const std::size_t all = RightTriangles(side).triangulate({height_m, std::vector<float>(height_m.size(), 1e-3F)}).size();
  EXPECT_LT(few, all / 3);
}

TEST(RightTriangles, LeaveAHoleWhereThereIsNoHeight) {
  std::vector<float> height_m = rough_heights(9);
  const auto is_empty = [](std::uint32_t node) { return node % along > 10 && node % along < 20 && node / along > 5; };
  for (std::uint32_t n = 0; n < height_m.size(); ++n)
    if (is_empty(n)) height_m[n] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> tolerances(height_m.size(), 100.0F);
  double area = 0.0;
  for (const Triangle& t : RightTriangles(side).triangulate({height_m, tolerances})) {
    for (const std::uint32_t corner : {t.a, t.b, t.c}) EXPECT_FALSE(is_empty(corner));
    const double dx = double(t.a % along) - double(t.b % along), dy = double(t.a / along) - double(t.b / along);
    area += 0.25 * (dx * dx + dy * dy);  // of half a square over the hypotenuse
  }
  // All squares between nodes that have heights are there: 10 columns and 27 rows of squares are not, but at the corners of the
  // hole perhaps the half of a square that meets it with one node
  EXPECT_NEAR(area, side * side - 10.0 * 27.0 + 0.5, 0.5);
}

}  // namespace
}  // namespace farlod::far_terrain
