// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>

#include "tests/analytic/packed_around.hpp"

// What is seen by class, against closed forms: between two endless walls, in a square court, in front of a lower roof, below a
// slab, and above the ground.

namespace farlod {
namespace {

using Views = std::map<std::string, double>;
using std::numbers::pi;

constexpr Quantities both_halves{.view_factors = true, .view_factors_below = true};
/// 20,000 rays err by less than 2.4 · 20,000^(−3/4); walls end 900 m away, which is .001 of a view between them.
constexpr double views_tolerance = 0.0025;
constexpr std::array engines_of_views{Engine::automatic, Engine::rays, Engine::exact};

/// Of a level line to the right, the share of the view of an endless strip between two angles from the receiver's normal.
double strip(double from, double to) { return 0.5 * (std::sin(to) - std::sin(from)); }

double sum_of_classes(const Views& views) {
  double sum = 0.0;
  for (const auto& [name, value] : views)
    if (name.starts_with("view_") && !name.ends_with("_below")) sum += value;
  return sum;
}

void expect_views(const PackedAround& packed, const Views& expected, const Point3d& normal_city = {0.0, 0.0, 1.0}) {
  for (const Engine engine : engines_of_views) {
    SCOPED_TRACE(static_cast<int>(engine));
    const Views got = packed.columns(engine, both_halves, normal_city);
    EXPECT_EQ(got.size(), 18U);
    EXPECT_NEAR(sum_of_classes(got), 1.0, 1e-5);
    EXPECT_NEAR(got.at("view_sky"), got.at("svf"), 1e-6);
    for (const auto& [name, value] : got) {
      if (name == "svf") continue;
      const auto known = expected.find(name);
      EXPECT_NEAR(value, known == expected.end() ? 0.0 : known->second, views_tolerance) << name;
    }
  }
}

/// Two walls along an axis, without thickness.
auto walls_along(double axis_deg, double height_m, double right_m, double left_m) {
  return [=](scenes::SceneBuilder& builder) {
    const Angle axis = Angle::degrees(axis_deg);
    const Point2d along{sin(axis), cos(axis)}, right{cos(axis), -sin(axis)};
    for (const double side : {right_m, -left_m})
      builder.add_wall(side * right - 900.0 * along, side * right + 900.0 * along, -packed_eye_m, height_m);
  };
}

constexpr double street_height_m = 20.0, to_right_m = 6.0, to_left_m = 9.0;

TEST(ViewFactors, WallsOfAStreetFaceEachOther) {
  const double right = strip(0.5 * pi - std::atan(street_height_m / to_right_m), 0.5 * pi),
               left = strip(0.5 * pi - std::atan(street_height_m / to_left_m), 0.5 * pi);
  struct Street {
    double axis_deg;
    const char *on_right, *on_left;
  };
  // A wall on the right of a street to the north stands in the east, and faces west
  for (const Street& street : {Street{0.0, "view_wall_w", "view_wall_e"}, Street{40.0, "view_wall_w", "view_wall_e"},
                               Street{50.0, "view_wall_n", "view_wall_s"}, Street{90.0, "view_wall_n", "view_wall_s"},
                               Street{180.0, "view_wall_e", "view_wall_w"}})
    for (const double grid_deg : {0.0, 20.0}) {
      SCOPED_TRACE(std::to_string(street.axis_deg) + ", grid " + std::to_string(grid_deg));
      const PackedAround packed(Angle::degrees(grid_deg), walls_along(street.axis_deg, street_height_m, to_right_m, to_left_m));
      expect_views(packed, {{"view_sky", 1.0 - right - left}, {street.on_right, right}, {street.on_left, left}});
    }
}

TEST(ViewFactors, AWallSeesTheWallAndTheGroundBeforeIt) {
  const PackedAround packed(Angle::degrees(10.0), walls_along(0.0, street_height_m, to_right_m, to_left_m));
  const double top = std::atan(street_height_m / to_right_m), foot = std::atan(static_cast<double>(packed_eye_m) / to_right_m);
  expect_views(packed,
               {{"view_sky", strip(top, 0.5 * pi)},
                {"view_wall_w", strip(-foot, top)},
                {"view_wall_w_below", strip(-foot, 0.0)},
                {"view_ground", strip(-0.5 * pi, -foot)},
                {"view_ground_below", strip(-0.5 * pi, -foot)}},
               {1.0, 0.0, 0.0});
}

TEST(ViewFactors, WallsOfASquareCourtAreSeenAlike) {
  constexpr double half_m = 8.0, height_m = 10.0;
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    const std::array<Point2d, 4> corners{{{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}}};
    for (std::size_t n = 0; n < 4; ++n) builder.add_wall(corners[n], corners[(n + 1) % 4], -packed_eye_m, height_m);
  });
  // The square opening is four rectangles, each with a corner above the receiver
  const double a = half_m / height_m, root = std::sqrt(1.0 + a * a);
  const double sky = 4.0 / pi * a / root * std::atan(a / root), wall = 0.25 * (1.0 - sky);
  expect_views(packed,
               {{"view_sky", sky}, {"view_wall_n", wall}, {"view_wall_e", wall}, {"view_wall_s", wall}, {"view_wall_w", wall}});
}

TEST(ViewFactors, ARoofIsSeenBelow) {
  constexpr double below_m = 0.5, from_m = 1.0, to_m = 5.0;
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    builder.add_box({{from_m, -900.0}, {to_m, 900.0}}, -packed_eye_m, -below_m);
  });
  const double foot = std::atan(packed_eye_m / from_m), near_edge = std::atan(below_m / from_m),
               far_edge = std::atan(below_m / to_m);
  const double ground = strip(-0.5 * pi, -foot) + strip(-far_edge, 0.0), wall = strip(-foot, -near_edge),
               roof = strip(-near_edge, -far_edge);
  expect_views(packed,
               {{"view_sky", 0.5},
                {"view_ground", ground},
                {"view_ground_below", ground},
                {"view_wall_w", wall},
                {"view_wall_w_below", wall},
                {"view_roof", roof},
                {"view_roof_below", roof}},
               {1.0, 0.0, 0.0});
}

TEST(ViewFactors, AnUndersideIsSomethingElse) {
  constexpr double half_m = 6.0, height_m = 4.0;
  const double a = half_m / height_m, root = std::sqrt(1.0 + a * a), slab = 4.0 / pi * a / root * std::atan(a / root);
  const std::vector<Point3d> outline{
      {-half_m, -half_m, height_m}, {half_m, -half_m, height_m}, {half_m, half_m, height_m}, {-half_m, half_m, height_m}};
  // Whichever side of a single polygon is its front
  for (const bool looks_up : {true, false}) {
    const PackedAround packed({}, [&](scenes::SceneBuilder& builder) {
      builder.add_polygon(looks_up ? outline : std::vector<Point3d>(outline.rbegin(), outline.rend()));
    });
    expect_views(packed, {{"view_sky", 1.0 - slab}, {"view_other", slab}});
  }
}

TEST(ViewFactors, TheLowerHalfOfAnOpenFieldIsGround) {
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  expect_views(open, {{"view_sky", 1.0}});
  expect_views(open, {{"view_sky", 0.5}, {"view_ground", 0.5}, {"view_ground_below", 0.5}}, {0.0, 1.0, 0.0});
  const double tilt = pi / 3.0, below = 0.5 * (1.0 - std::cos(tilt));
  expect_views(open, {{"view_sky", 1.0 - below}, {"view_ground", below}, {"view_ground_below", below}},
               {std::sin(tilt), 0.0, std::cos(tilt)});
  expect_views(open, {{"view_ground", 1.0}, {"view_ground_below", 1.0}}, {0.0, 0.0, -1.0});
}

}  // namespace
}  // namespace farlod
