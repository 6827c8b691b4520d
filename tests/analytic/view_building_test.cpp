// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "farlod/error.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/packed_around.hpp"

// What one building fills of the view: alone in the open, near and far, behind walls and crowns, and below the eye.

namespace farlod {
namespace {

using Columns = std::map<std::string, double>;

constexpr std::array engines_that_look{Engine::automatic, Engine::horizon, Engine::rays, Engine::exact};
constexpr double tower_m = 25.0, tower_right_m = 12.0, tower_left_m = 8.0;

/// 20,000 rays to the window err by less than 2.4 · 20,000^(−3/4) of the window, which is less than three times as large as what
/// is seen of the building.
constexpr double relative_tolerance = 3.0 * 0.0015;

Quantities looking_for(const std::string& id) { return {.seen_building = id}; }

/// The first building: a box whose upright side towards the receiver is so far away in the north.
void add_tower(scenes::SceneBuilder& builder, double distance_m) {
  builder.add_box({{-tower_left_m, distance_m}, {tower_right_m, distance_m + 20.0}}, -packed_eye_m, tower_m);
}

/// Of a level view, what the side of a box hides of the sky up to a height.
double side_cosine(double top_m, double distance_m) {
  return 1.0 - oracles::finite_wall_cos(top_m, distance_m, tower_right_m, tower_left_m);
}
double side_solid(double top_m, double distance_m) {
  return 1.0 - oracles::finite_wall_solid(top_m, distance_m, tower_right_m, tower_left_m);
}

void expect_seen(const Columns& got, double share) {
  EXPECT_NEAR(got.at("view_building"), share, relative_tolerance * share);
  EXPECT_EQ(got.at("sees_building"), 1.0);
}
void expect_unseen(const Columns& got) {
  EXPECT_EQ(got.at("view_building"), 0.0);
  EXPECT_EQ(got.at("sees_building"), 0.0);
}

TEST(ViewBuilding, ABoxInTheOpenFillsItsSolidAngle) {
  for (const double grid_deg : {0.0, 20.0})
    for (const double distance_m : {10.0, 30.0, 600.0}) {
      const PackedAround packed(Angle::degrees(grid_deg), [&](scenes::SceneBuilder& builder) { add_tower(builder, distance_m); });
      for (const Engine engine : engines_that_look) {
        SCOPED_TRACE(std::to_string(distance_m) + " m, grid " + std::to_string(grid_deg));
        expect_seen(packed.columns(engine, looking_for("box 0")), side_cosine(tower_m, distance_m));
        expect_seen(packed.columns(engine, looking_for("box 0"), {0.0, 0.0, 1.0}, SkyWeight::solid_angle),
                    side_solid(tower_m, distance_m));
      }
    }
}

TEST(ViewBuilding, AHigherWallBeforeItHidesAll) {
  const PackedAround packed(Angle::degrees(20.0), [](scenes::SceneBuilder& builder) {
    add_tower(builder, 300.0);
    builder.add_wall({-900.0, 100.0}, {900.0, 100.0}, -packed_eye_m, tower_m);
  });
  for (const Engine engine : engines_that_look) expect_unseen(packed.columns(engine, looking_for("box 0")));
}

/// The top of a wall halfway hides what lies below twice its height.
TEST(ViewBuilding, ALowerWallBeforeItHidesItsFoot) {
  constexpr double distance_m = 300.0, wall_m = 8.0;
  const PackedAround packed(Angle::degrees(20.0), [](scenes::SceneBuilder& builder) {
    add_tower(builder, distance_m);
    builder.add_wall({-900.0, 0.5 * distance_m}, {900.0, 0.5 * distance_m}, -packed_eye_m, wall_m);
  });
  for (const Engine engine : engines_that_look)
    expect_seen(packed.columns(engine, looking_for("box 0")),
                side_cosine(tower_m, distance_m) - side_cosine(2.0 * wall_m, distance_m));
}

TEST(ViewBuilding, OtherBuildingsDoNotCount) {
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    add_tower(builder, 30.0);
    builder.add_box({{-40.0, 30.0}, {-tower_left_m, 50.0}}, -packed_eye_m, tower_m);
  });
  const Columns got = packed.columns(Engine::automatic, {.view_factors = true, .seen_building = "box 0"});
  expect_seen(got, side_cosine(tower_m, 30.0));
  EXPECT_GT(got.at("view_wall_s"), 1.5 * got.at("view_building"));
}

/// A strip along a line of sight that goes east, from 1 m to 5 m and half a metre below the eye.
TEST(ViewBuilding, WhatLiesBelowTheEyeIsSeenByThoseWhoLookThere) {
  constexpr double below_m = 0.5, near_m = 1.0, end_m = 5.0;
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) {
    builder.add_box({{near_m, -900.0}, {end_m, 900.0}}, -packed_eye_m, -below_m);
  });
  for (const Engine engine : engines_that_look) {
    const Columns level = packed.columns(engine, looking_for("box 0"));
    EXPECT_EQ(level.at("view_building"), 0.0);
    EXPECT_EQ(level.at("sees_building"), 1.0);
    const double foot = std::atan(packed_eye_m / near_m), far_edge = std::atan(below_m / end_m);
    expect_seen(packed.columns(engine, looking_for("box 0"), {1.0, 0.0, 0.0}), 0.5 * (std::sin(foot) - std::sin(far_edge)));
    expect_unseen(packed.columns(engine, looking_for("box 0"), {-1.0, 0.0, 0.0}));
  }
}

/// The receiver stands below a slab.
TEST(ViewBuilding, WhatIsOverheadIsSeenAllAround) {
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) { builder.add_box({{-10.0, -10.0}, {10.0, 10.0}}, 4.0, 5.0); });
  for (const Engine engine : engines_that_look)
    expect_seen(packed.columns(engine, looking_for("box 0")), 4.0 * oracles::court_quadrant_cos(10.0, 10.0, 4.0));
}

TEST(ViewBuilding, CrownsHideWhatIsBehindThem) {
  PackedAround packed({}, [](scenes::SceneBuilder& builder) { add_tower(builder, 300.0); });
  const package::Manifest& manifest = packed.package().manifest();
  CrownsOfCity crowns(manifest.grid, manifest.height_origin_m);
  crowns.add({0.5 * packed_cell_edge_m, 0.5 * packed_cell_edge_m + 15.0}, 0.0, packed_eye_m + 10.0, 10.0, CrownShape::prism,
             Foliage::unknown, 0.0);
  packed.plant(std::move(crowns));
  for (const Engine engine : engines_that_look) expect_unseen(packed.columns(engine, looking_for("box 0")));
}

TEST(ViewBuilding, ABuildingThatThereIsNotIsRefused) {
  const PackedAround packed({}, [](scenes::SceneBuilder& builder) { add_tower(builder, 30.0); });
  try {
    (void)packed.columns(Engine::automatic, looking_for("bax 0"));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "the package has no building \"bax 0\"; did you mean box 0?");
  }
  try {
    (void)packed.columns(Engine::automatic, looking_for("cathedral"));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "the package has no building \"cathedral\": it has such as box 0, box 1");
  }
}

}  // namespace
}  // namespace farlod
