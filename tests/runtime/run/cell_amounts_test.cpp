// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/cell_amounts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace farlod {
namespace {

constexpr double rounding_m2 = 1e-9;

CellFace face_of_triangle(const FlatTriangle& t, std::uint32_t building) {
  CellFace face;
  face.corners = t;
  face.normal = face.of_surface = normalized(cross(t[1] - t[0], t[2] - t[0]));
  face.building = building;
  face.low = {std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y}), std::min({t[0].z, t[1].z, t[2].z})};
  face.high = {std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y}), std::max({t[0].z, t[1].z, t[2].z})};
  return face;
}

/// Corners run counter-clockwise seen from outside.
void add_fan(std::vector<CellFace>& faces, const std::vector<Point3d>& corners, std::uint32_t building = 0) {
  for (std::size_t n = 2; n < corners.size(); ++n)
    faces.push_back(face_of_triangle({corners[0], corners[n - 1], corners[n]}, building));
}

/// Ground of 100 m × 100 m that rises by `slope` to the east.
CellFaces on_ground(double slope) {
  CellFaces faces;
  add_fan(faces.ground, {{0, 0, 0}, {100, 0, 100 * slope}, {100, 100, 100 * slope}, {0, 100, 0}});
  return faces;
}

/// The winds in the plan of an unturned grid, whose north is true.
WindDirections true_winds() {
  WindDirections winds;
  for (std::size_t k = 0; k < winds.size(); ++k) {
    const double azimuth = 2.0 * std::numbers::pi * static_cast<double>(k) / wind_directions;
    winds[k] = {std::sin(azimuth), std::cos(azimuth)};
  }
  return winds;
}

/// Walls around a rectangle from one level to another.
void add_box_walls(CellFaces& faces, const Box2d& b, double low_m, double high_m) {
  const std::array<Point2d, 4> ring{b.low, Point2d{b.high.x, b.low.y}, b.high, Point2d{b.low.x, b.high.y}};
  for (std::size_t n = 0; n < 4; ++n) {
    const Point2d p = ring[n], q = ring[(n + 1) % 4];
    add_fan(faces.walls, {{p.x, p.y, low_m}, {q.x, q.y, low_m}, {q.x, q.y, high_m}, {p.x, p.y, high_m}});
  }
}

/// A house of 10 m × 20 m with eaves at 6 m and a ridge at 9 m, along the y axis.
CellFaces gabled_house() {
  CellFaces faces = on_ground(0.0);
  add_fan(faces.roofs, {{40, 40, 6}, {45, 40, 9}, {45, 60, 9}, {40, 60, 6}});
  add_fan(faces.roofs, {{50, 40, 6}, {50, 60, 6}, {45, 60, 9}, {45, 40, 9}});
  add_box_walls(faces, {{40, 40}, {50, 60}}, 0.0, 6.0);
  add_fan(faces.walls, {{40, 40, 6}, {50, 40, 6}, {45, 40, 9}});
  add_fan(faces.walls, {{50, 60, 6}, {40, 60, 6}, {45, 60, 9}});
  return faces;
}

TEST(CellAmounts, AGabledHouseHasTheAreaOfItsSlopes) {
  const CellAmounts a = form_of(gabled_house(), true_winds()).all();
  EXPECT_NEAR(a.building_plan_area_m2, 200.0, rounding_m2);
  EXPECT_NEAR(a.roof_area_m2, 2.0 * 20.0 * std::hypot(5.0, 3.0), rounding_m2);
  EXPECT_NEAR(a.wall_area_m2, 60.0 * 6.0 + 2.0 * 15.0, rounding_m2);
  EXPECT_NEAR(a.volume_m3, 200.0 * 6.0 + 0.5 * 10.0 * 3.0 * 20.0, 10.0 * rounding_m2);
  // The height is evenly spread from 6 m to 9 m
  EXPECT_NEAR(a.height_moment_m4, 200.0 * (7.5 * 7.5 + 9.0 / 12.0), 100.0 * rounding_m2);
  EXPECT_EQ(a.height_max_m, 9.0);
  EXPECT_NEAR(a.frontal_area_m2[0], 75.0, rounding_m2) << "a gable";
  EXPECT_NEAR(a.frontal_area_m2[4], 20.0 * 9.0, rounding_m2) << "a side and the slope above it";
  EXPECT_NEAR(a.frontal_area_m2[12], 20.0 * 9.0, rounding_m2);
}

/// A roof that rises from 2 m to 22 m over 40 m: what lies between two heights is as wide as they are apart.
TEST(CellAmounts, ASlopeIsPartedByItsHeights) {
  CellFaces faces = on_ground(0.0);
  add_fan(faces.roofs, {{40, 40, 2}, {80, 40, 22}, {80, 60, 22}, {40, 60, 2}});
  const CellAmounts a = form_of(faces, true_winds()).all();
  for (const auto& [bin, rise_m] : {std::pair<std::size_t, double>(0, 3.0), {1, 5.0}, {2, 5.0}, {3, 5.0}, {4, 2.0}, {5, 0.0}})
    EXPECT_NEAR(a.plan_area_by_height_m2.at(bin), 800.0 * rise_m / 20.0, 10.0 * rounding_m2) << bin;
}

/// Level roofs on ground that rises by a tenth: heights count from the ground, and the last bin takes all that is higher.
TEST(CellAmounts, HeightsOfBinsCountFromTheGround) {
  CellFaces faces = on_ground(0.1);
  add_fan(faces.roofs, {{0, 40, 12}, {40, 40, 12}, {40, 60, 12}, {0, 60, 12}});
  add_fan(faces.roofs, {{80, 40, 300}, {90, 40, 300}, {90, 60, 300}, {80, 60, 300}}, 1);
  const CellAmounts a = form_of(faces, true_winds()).all();
  EXPECT_NEAR(a.plan_area_by_height_m2[2], 400.0, 10.0 * rounding_m2) << "12 m to 10 m";
  EXPECT_NEAR(a.plan_area_by_height_m2[1], 400.0, 10.0 * rounding_m2) << "10 m to 8 m";
  EXPECT_NEAR(a.plan_area_by_height_m2[14], 200.0, 10.0 * rounding_m2);
  UrbanForm form;
  form.amounts = a;
  EXPECT_NEAR(*form.height_share(14), 0.2, 1e-12);
}

/// A house on ground that rises by a tenth, from 5 m below its lowest place to a level roof at 20 m.
TEST(CellAmounts, WhatLiesBelowTheGroundDoesNotCount) {
  CellFaces faces = on_ground(0.1);
  add_fan(faces.roofs, {{40, 40, 20}, {60, 40, 20}, {60, 60, 20}, {40, 60, 20}});
  add_box_walls(faces, {{40, 40}, {60, 60}}, -5.0, 20.0);
  const CellAmounts a = form_of(faces, true_winds()).all();
  EXPECT_NEAR(a.building_plan_area_m2, 400.0, rounding_m2);
  EXPECT_NEAR(a.wall_area_m2, 20.0 * (16.0 + 14.0 + 15.0 + 15.0), 10.0 * rounding_m2);
  EXPECT_NEAR(a.frontal_area_m2[12], 20.0 * 16.0, 10.0 * rounding_m2);
  EXPECT_NEAR(a.volume_m3, 400.0 * 15.0, 100.0 * rounding_m2);
  EXPECT_NEAR(a.height_max_m, 16.0, rounding_m2);
}

TEST(CellAmounts, AGarageBelowTheGroundIsNoBuilding) {
  CellFaces faces = on_ground(0.0);
  add_fan(faces.roofs, {{40, 40, -1}, {60, 40, -1}, {60, 60, -1}, {40, 60, -1}});
  add_box_walls(faces, {{40, 40}, {60, 60}}, -4.0, -1.0);
  const CellAmounts a = form_of(faces, true_winds()).all();
  EXPECT_EQ(a.building_plan_area_m2 + a.wall_area_m2 + a.frontal_area_m2[0], 0.0);
  EXPECT_EQ(a.buildings, 0U);
}

/// Two roofs that cross each other like an X: the higher one counts on either side.
TEST(CellAmounts, RoofsThatCrossCountAtTheHigherOne) {
  CellFaces faces = on_ground(0.0);
  add_fan(faces.roofs, {{40, 40, 10}, {60, 40, 20}, {60, 60, 20}, {40, 60, 10}});
  add_fan(faces.roofs, {{40, 40, 20}, {60, 40, 10}, {60, 60, 10}, {40, 60, 20}}, 1);
  const CellAmounts a = form_of(faces, true_winds()).all();
  EXPECT_NEAR(a.building_plan_area_m2, 400.0, rounding_m2);
  EXPECT_NEAR(a.volume_m3, 400.0 * 17.5, 100.0 * rounding_m2);
  EXPECT_EQ(a.buildings, 2U);
}

/// A wall along the side that the two triangles of the ground share.
TEST(CellAmounts, AWallAboveASideOfTheGroundCountsOnce) {
  CellFaces faces = on_ground(0.0);
  add_fan(faces.walls, {{20, 20, -1}, {30, 30, -1}, {30, 30, 9}, {20, 20, 9}});
  EXPECT_NEAR(form_of(faces, true_winds()).all().wall_area_m2, 9.0 * std::hypot(10.0, 10.0), rounding_m2);
}

/// Two walls back to back, of which one turns away: they are a party wall where they are closer than 2 cm.
TEST(CellAmounts, PartyWallsEndWhereWallsPart) {
  CellFaces faces = on_ground(0.0);
  add_fan(faces.walls, {{50, 20, 0}, {50, 30, 0}, {50, 30, 10}, {50, 20, 10}});
  const double off_m = 0.08;  // at the far end: less than a degree
  add_fan(faces.walls, {{50 - off_m, 30, 0}, {50, 20, 0}, {50, 20, 10}, {50 - off_m, 30, 10}});
  EXPECT_NEAR(form_of(faces, true_winds()).all().wall_area_m2, 2.0 * 100.0 * 0.75, 0.02);
}

}  // namespace
}  // namespace farlod
