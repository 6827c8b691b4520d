// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "far_terrain/cut_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace farlod::far_terrain {
namespace {

double area_of(const std::array<Point3d, 3>& t) {
  return 0.5 * std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x));
}

constexpr Box2d rectangle{{-10.0, -5.0}, {20.0, 15.0}};

/// Of a triangle within the rectangle, by places at random.
double share_within(const std::array<Point3d, 3>& t, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int places = 20000;
  int within = 0;
  for (int n = 0; n < places; ++n) {
    double u = uniform(random), v = uniform(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    within += rectangle.contains(horizontal(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]))) ? 1 : 0;
  }
  return static_cast<double>(within) / places;
}

TEST(CutOut, LeavesWhatLiesOutside) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-40.0, 50.0), height(0.0, 10.0);
  for (int n = 0; n < 200; ++n) {
    std::array<Point3d, 3> triangle;
    for (Point3d& p : triangle) p = {place(random), place(random), height(random)};
    double area = 0.0;
    const Point3d normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    for (const std::array<Point3d, 3>& part : outside_of(rectangle, triangle)) {
      area += area_of(part);
      const Point3d middle = (1.0 / 3.0) * (part[0] + part[1] + part[2]);
      EXPECT_FALSE(rectangle.low.x + 1e-9 < middle.x && middle.x < rectangle.high.x - 1e-9 && rectangle.low.y + 1e-9 < middle.y &&
                   middle.y < rectangle.high.y - 1e-9);
      for (const Point3d& p : part) EXPECT_NEAR(dot(normal, p - triangle[0]) / norm(normal), 0.0, 1e-9) << "in its plane";
    }
    EXPECT_NEAR(area, area_of(triangle) * (1.0 - share_within(triangle, random)), 0.02 * area_of(triangle));
  }
}

TEST(CutOut, TrianglesBesideEachOtherStillMeet) {
  const Point3d a{-30.0, 3.0, 1.0}, b{33.0, 7.0, 9.0}, above{0.0, 40.0, 4.0}, below{0.0, -40.0, 2.0};
  const auto ends_on = [&](const std::array<Point3d, 3>& triangle) {
    std::vector<std::array<double, 3>> places;
    for (const auto& part : outside_of(rectangle, triangle))
      for (const Point3d& p : part)
        if (std::abs(cross(b - a, p - a).z) < 1e-6) places.push_back({p.x, p.y, p.z});
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  };
  EXPECT_EQ(ends_on({a, b, above}), ends_on({below, b, a})) << "bit by bit";
  EXPECT_EQ(ends_on({a, b, above}).size(), 4U);
}

}  // namespace
}  // namespace farlod::far_terrain
