// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "generator/building_plan.hpp"

namespace farlod {
namespace {

CitySettings city_with_bridges(double relief_m) {
  CitySettings settings;
  settings.size_m = 2000.0;
  settings.overhangs = true;
  settings.terrain_relief_m = relief_m;
  return settings;
}

std::int64_t cm(double x_m) { return std::llround(100.0 * x_m); }

/// Whether a building's upper wall covers the end of a bridge: the part of the line across the street at `place`.
bool covers(const UrbanField& field, const BuildingPlan& building, const BuildingPlan& bridge, bool north_south, double place_m) {
  const Box2d wall = plan_rectangle(building), deck = plan_rectangle(bridge);
  const double ground_m = base_m(field, building), bridge_ground_m = base_m(field, bridge);
  const bool beside = north_south ? wall.low.x <= deck.low.x && deck.high.x <= wall.high.x
                                  : wall.low.y <= deck.low.y && deck.high.y <= wall.high.y;
  const bool at_wall = north_south ? cm(wall.low.y) == cm(place_m) || cm(wall.high.y) == cm(place_m)
                                   : cm(wall.low.x) == cm(place_m) || cm(wall.high.x) == cm(place_m);
  const bool high_enough = cm(ground_m + building.wall_m) >= cm(bridge_ground_m + bridge.wall_m);
  const bool above_arcade = cm(bridge_ground_m + bridge.clearance_m) >= cm(ground_m + building.arcade_height_m);
  return beside && at_wall && high_enough && above_arcade;
}

bool any_covers(const CitySettings& settings, CityBlock block, const BuildingPlan& bridge, bool north_south, double place_m) {
  for (const BuildingPlan& building : plans_of_block(settings, block))
    if (covers(UrbanField(settings), building, bridge, north_south, place_m)) return true;
  return false;
}

void check_bridge(const CitySettings& settings, CityBlock block, const BuildingPlan& bridge) {
  const Box2d deck = plan_rectangle(bridge), own = CityLayout(settings).rectangle(block);
  const bool north_south = cm(deck.low.y) == cm(own.high.y);
  const CityBlock neighbor = north_south ? CityBlock{block.i, block.j + 1} : CityBlock{block.i + 1, block.j};
  const UrbanField field(settings);
  for (const Point2d p : {deck.low, deck.high, Point2d{deck.low.x, deck.high.y}, Point2d{deck.high.x, deck.low.y}})
    EXPECT_GE(base_m(field, bridge) + bridge.clearance_m, field.ground_m(p) + 5.0);
  EXPECT_GT(bridge.wall_m, bridge.clearance_m);
  EXPECT_TRUE(any_covers(settings, block, bridge, north_south, north_south ? deck.low.y : deck.low.x));
  EXPECT_TRUE(any_covers(settings, neighbor, bridge, north_south, north_south ? deck.high.y : deck.high.x));
}

TEST(BridgePlans, RunFromWallToWallAboveTheStreet) {
  for (const double relief_m : {0.0, 50.0}) {
    const CitySettings settings = city_with_bridges(relief_m);
    const CityLayout layout(settings);
    int bridges = 0;
    for (std::int64_t k = 0; k < layout.block_count(); ++k)
      for (const BuildingPlan& bridge : bridges_of_block(settings, layout.block_at(k))) {
        ++bridges;
        check_bridge(settings, layout.block_at(k), bridge);
      }
    EXPECT_GT(bridges, 10);
  }
}

TEST(BridgePlans, ThereAreNoneWithoutOverhangs) {
  CitySettings settings = city_with_bridges(0.0);
  settings.overhangs = false;
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) EXPECT_TRUE(bridges_of_block(settings, layout.block_at(k)).empty());
}

}  // namespace
}  // namespace farlod
