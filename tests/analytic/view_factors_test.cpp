// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <string_view>

#include "tests/analytic/packed_around.hpp"

// What is seen by class, against closed forms: between two endless walls, in a square and in an eight-sided court, in front of a
// lower roof, below a slab, and above the ground; by cosine and by solid angle, and around a place.

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

double sum_of_classes(const Views& views, std::string_view ending = "") {
  double sum = 0.0;
  for (const auto& [name, value] : views) {
    const std::string_view text = name;
    const std::size_t classes_end = text.rfind(ending);
    const std::string_view what = ending.empty() ? text : text.substr(0, classes_end);
    const bool is_class = what == "view_sky" || what == "view_ground" || what == "view_roof" || what == "view_crown" ||
                          what == "view_other" || (what.starts_with("view_wall_") && what.size() <= 12);
    if (is_class && classes_end != std::string_view::npos && text.ends_with(ending)) sum += value;
  }
  return sum;
}

/// All columns but svf: those that are not expected are 0.
void expect_columns(const Views& got, const Views& expected) {
  for (const auto& [name, value] : got) {
    if (name == "svf") continue;
    const auto known = expected.find(name);
    EXPECT_NEAR(value, known == expected.end() ? 0.0 : known->second, views_tolerance) << name;
  }
  for (const auto& [name, value] : expected) EXPECT_TRUE(got.contains(name)) << name;
}

void expect_views(const PackedAround& packed, const Views& expected, const Point3d& normal_city = {0.0, 0.0, 1.0},
                  SkyWeight weight = SkyWeight::cosine) {
  for (const Engine engine : engines_of_views) {
    SCOPED_TRACE(static_cast<int>(engine));
    const Views got = packed.columns(engine, both_halves, normal_city, weight);
    EXPECT_EQ(got.size(), 18U);
    EXPECT_NEAR(sum_of_classes(got), 1.0, 1e-5);
    EXPECT_NEAR(got.at("view_sky"), got.at("svf"), 1e-6);
    expect_columns(got, expected);
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

TEST(ViewFactors, WallsGoByEightAzimuthsWhereAsked) {
  const double right = strip(0.5 * pi - std::atan(street_height_m / to_right_m), 0.5 * pi),
               left = strip(0.5 * pi - std::atan(street_height_m / to_left_m), 0.5 * pi);
  struct Street {
    double axis_deg;
    const char *on_right, *on_left;
  };
  for (const Street& street : {Street{0.0, "view_wall_w", "view_wall_e"}, Street{20.0, "view_wall_w", "view_wall_e"},
                               Street{25.0, "view_wall_nw", "view_wall_se"}, Street{65.0, "view_wall_nw", "view_wall_se"},
                               Street{70.0, "view_wall_n", "view_wall_s"}, Street{-25.0, "view_wall_sw", "view_wall_ne"}}) {
    SCOPED_TRACE(street.axis_deg);
    const PackedAround packed(Angle::degrees(20.0), walls_along(street.axis_deg, street_height_m, to_right_m, to_left_m));
    const Quantities by_eighths{.view_factors = true, .wall_sectors = 8};
    for (const Engine engine : engines_of_views) {
      const Views got = packed.columns(engine, by_eighths);
      EXPECT_EQ(got.size(), 14U);
      EXPECT_NEAR(sum_of_classes(got), 1.0, 1e-5);
      expect_columns(got, {{"view_sky", 1.0 - right - left}, {street.on_right, right}, {street.on_left, left}});
    }
  }
}

TEST(ViewFactors, WallsOfAnEightSidedCourtAreSeenAlike) {
  constexpr double apothem_m = 8.0, height_m = 10.0, turned_deg = 17.0;
  const PackedAround packed(Angle::degrees(-11.0), [](scenes::SceneBuilder& builder) {
    const auto corner = [](std::size_t n) {
      const Angle azimuth = Angle::degrees(turned_deg + 22.5 + 45.0 * static_cast<double>(n));
      return apothem_m / std::cos(pi / 8.0) * Point2d{sin(azimuth), cos(azimuth)};
    };
    for (std::size_t n = 0; n < 8; ++n) builder.add_wall(corner(n), corner(n + 1), -packed_eye_m, height_m);
  });
  // Each edge of the opening subtends an angle, in a plane whose tilt the formula of the contour weights
  const double to_edge_m = std::hypot(apothem_m, height_m);
  const double sky = 8.0 / pi * std::atan(apothem_m * std::tan(pi / 8.0) / to_edge_m) * apothem_m / to_edge_m;
  Views expected{{"view_sky", sky}};
  for (const char* azimuth : {"n", "ne", "e", "se", "s", "sw", "w", "nw"})
    expected[std::string("view_wall_") + azimuth] = 0.125 * (1.0 - sky);
  expect_columns(packed.columns(Engine::automatic, {.view_factors = true, .wall_sectors = 8}), expected);
}

/// The share of a hemisphere's solid angle between two planes through a level line in its base: a lune.
double lune(double from, double to) { return (to - from) / pi; }

TEST(ViewFactors, BySolidAngleAreLunesBetweenEndlessWalls) {
  const PackedAround packed(Angle::degrees(10.0), walls_along(0.0, street_height_m, to_right_m, to_left_m));
  const double right = std::atan(street_height_m / to_right_m), left = std::atan(street_height_m / to_left_m),
               foot = std::atan(static_cast<double>(packed_eye_m) / to_right_m);
  expect_views(packed,
               {{"view_sky", 1.0 - lune(0.0, right) - lune(0.0, left)},
                {"view_wall_w", lune(0.0, right)},
                {"view_wall_e", lune(0.0, left)}},
               {0.0, 0.0, 1.0}, SkyWeight::solid_angle);
  expect_views(packed,
               {{"view_sky", lune(right, 0.5 * pi)},
                {"view_wall_w", lune(-foot, right)},
                {"view_wall_w_below", lune(-foot, 0.0)},
                {"view_ground", lune(-0.5 * pi, -foot)},
                {"view_ground_below", lune(-0.5 * pi, -foot)}},
               {1.0, 0.0, 0.0}, SkyWeight::solid_angle);
}

TEST(ViewFactors, OfTheOpenFieldBySolidAngleAreThoseOfTilts) {
  const PackedAround open({}, [](scenes::SceneBuilder&) {});
  for (const double tilt : {0.0, pi / 6.0, pi / 2.0, 0.75 * pi, pi}) {
    SCOPED_TRACE(tilt);
    const double below = tilt / pi;
    expect_views(open, {{"view_sky", 1.0 - below}, {"view_ground", below}, {"view_ground_below", below}},
                 {std::sin(tilt), 0.0, std::cos(tilt)}, SkyWeight::solid_angle);
  }
}

/// The street along north with walls that face east and west: what is around its middle.
class AroundAPlace : public testing::Test {
 protected:
  static double angle(double height_m, double away_m) { return std::atan(height_m / away_m); }
  const double top_right = angle(street_height_m, to_right_m), top_left = angle(street_height_m, to_left_m),
               foot_right = angle(static_cast<double>(packed_eye_m), to_right_m),
               foot_left = angle(static_cast<double>(packed_eye_m), to_left_m);
  /// Shares of the turn about the street's axis: those of the sphere, and of the faces that look along the street.
  [[nodiscard]] Views turn(const std::string& ending) const {
    const auto share = [](double part) { return part / (2.0 * pi); };
    return {{"view_sky" + ending, share(pi - top_right - top_left)},
            {"view_wall_w" + ending, share(top_right + foot_right)},
            {"view_wall_e" + ending, share(top_left + foot_left)},
            {"view_ground" + ending, share(pi - foot_right - foot_left)}};
  }
  const PackedAround packed{Angle::degrees(10.0), walls_along(0.0, street_height_m, to_right_m, to_left_m)};
};

TEST_F(AroundAPlace, TheFacesOfACubeSeeWhatReceiversDo) {
  Views expected = turn("_north");
  expected.merge(turn("_south"));
  const double up_right = strip(0.5 * pi - top_right, 0.5 * pi), up_left = strip(0.5 * pi - top_left, 0.5 * pi),
               down_right = strip(0.5 * pi - foot_right, 0.5 * pi), down_left = strip(0.5 * pi - foot_left, 0.5 * pi);
  expected.merge(Views{{"view_sky_up", 1.0 - up_right - up_left},
                       {"view_wall_w_up", up_right},
                       {"view_wall_e_up", up_left},
                       {"view_ground_down", 1.0 - down_right - down_left},
                       {"view_wall_w_down", down_right},
                       {"view_wall_e_down", down_left},
                       {"view_sky_east", strip(top_right, 0.5 * pi)},
                       {"view_wall_w_east", strip(-foot_right, top_right)},
                       {"view_ground_east", strip(-0.5 * pi, -foot_right)},
                       {"view_sky_west", strip(top_left, 0.5 * pi)},
                       {"view_wall_e_west", strip(-foot_left, top_left)},
                       {"view_ground_west", strip(-0.5 * pi, -foot_left)}});
  for (const Engine engine : engines_of_views)
    // The receiver's own normal does not matter
    for (const Point3d& normal : {Point3d{0.0, 0.0, 1.0}, Point3d{0.0, 1.0, 0.0}}) {
      const Views got = packed.columns(engine, {.view_cube = true}, normal);
      EXPECT_EQ(got.size(), 1 + 6 * 9U);
      for (const char* face : {"_up", "_down", "_north", "_east", "_south", "_west"})
        EXPECT_NEAR(sum_of_classes(got, face), 1.0, 1e-5) << face;
      expect_columns(got, expected);
    }
}

TEST_F(AroundAPlace, TheSphereIsSharesOfTheTurn) {
  for (const Engine engine : engines_of_views) {
    const Views got = packed.columns(engine, {.view_sphere = true});
    EXPECT_EQ(got.size(), 10U);
    EXPECT_NEAR(sum_of_classes(got, "_sphere"), 1.0, 1e-5);
    expect_columns(got, turn("_sphere"));
  }
}

/// Of the field within ±`half_field` of the horizontal, the share that an endless wall fills between the horizontal and its top,
/// or its foot; summed over the half of the turn that looks at it.
double wall_in_field(double height_m, double away_m, double half_field) {
  constexpr int steps = 20000;
  double sum = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double from_axis = (static_cast<double>(n) + 0.5) / steps * pi;
    const double elevation = std::atan(height_m / away_m * std::sin(from_axis));
    sum += std::sin(std::min(elevation, half_field));
  }
  return sum / steps / (4.0 * std::sin(half_field));
}

TEST_F(AroundAPlace, TheEyeSeesABandAroundTheHorizontal) {
  const auto height_m = static_cast<double>(packed_eye_m);
  for (const double field_deg : {30.0, 10.0, 60.0}) {
    SCOPED_TRACE(field_deg);
    const double field = field_deg / 180.0 * pi, above_right = wall_in_field(street_height_m, to_right_m, field),
                 above_left = wall_in_field(street_height_m, to_left_m, field),
                 below_right = wall_in_field(height_m, to_right_m, field), below_left = wall_in_field(height_m, to_left_m, field);
    for (const Engine engine : engines_of_views) {
      const Views got = packed.columns(engine, {.view_eye = true, .eye_field_deg = field_deg});
      EXPECT_NEAR(sum_of_classes(got, "_eye"), 1.0, 1e-5);
      expect_columns(got, {{"view_sky_eye", 0.5 - above_right - above_left},
                           {"view_wall_w_eye", above_right + below_right},
                           {"view_wall_e_eye", above_left + below_left},
                           {"view_ground_eye", 0.5 - below_right - below_left}});
    }
  }
}

TEST_F(AroundAPlace, TheEyesWholeFieldIsTheSphere) {
  expect_columns(packed.columns(Engine::automatic, {.view_eye = true, .eye_field_deg = 90.0}), turn("_eye"));
}

}  // namespace
}  // namespace farlod
