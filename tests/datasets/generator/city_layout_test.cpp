// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_layout.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/frame.hpp"
#include "generator/generated_building.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {
namespace {

CitySettings some_city() { return {.size_m = 2500.0, .seed = 11}; }

TEST(CityLayout, BlocksLieWithinTheCity) {
  const CitySettings settings = some_city();
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    const Box2d block = layout.rectangle(layout.block_at(k));
    EXPECT_FALSE(block.empty());
    for (const double x : {block.low.x, block.low.y, block.high.x, block.high.y}) EXPECT_LE(std::abs(x), 0.5 * settings.size_m);
  }
}

TEST(CityLayout, StreetsAreAtLeastAsWideAsAskedFor) {
  const CitySettings settings = some_city();
  const CityLayout layout(settings);
  int boulevards = 0;
  for (std::int32_t i = 0; i + 1 < layout.columns(); ++i) {
    const double width_m = on_plan_grid_m(layout.rectangle({i + 1, 0}).low.x - layout.rectangle({i, 0}).high.x);
    EXPECT_GE(width_m, settings.avenue_width_m);
    boulevards += width_m > settings.avenue_width_m ? 1 : 0;
  }
  EXPECT_GT(boulevards, 0);
  for (std::int32_t j = 0; j + 1 < layout.rows(); ++j)
    EXPECT_GE(on_plan_grid_m(layout.rectangle({0, j + 1}).low.y - layout.rectangle({0, j}).high.y), settings.street_width_m);
}

TEST(CityLayout, TheWidestStreetsAllowedStillLeaveBlocks) {
  CitySettings settings;
  for (double size_m = 100.0; size_m < 700.0; size_m += 30.0) {
    settings.size_m = size_m;
    settings.avenue_spacing_m = settings.street_spacing_m = 60.0;
    settings.avenue_width_m = settings.street_width_m = 15.0;
    const CityLayout layout(settings);
    for (std::int64_t k = 0; k < layout.block_count(); ++k) EXPECT_FALSE(layout.rectangle(layout.block_at(k)).empty()) << size_m;
  }
}

TEST(CityLayout, AvenuesHaveTheBearingOfTheRotation) {
  for (const double bearing_deg : {0.0, 29.0, 61.5, 90.0, 135.0}) {
    const Point2d along_avenue = PlanRotation(bearing_deg).city_from_plan({0.0, 1.0});
    // Both are within a few units in the last place of the angle
    EXPECT_DOUBLE_EQ(azimuth_of(along_avenue).degrees(), bearing_deg);
  }
}

TEST(CityLayout, SidesOfABlockCloseUp) {
  const Box2d block = CityLayout(some_city()).rectangle({3, 4});
  for (int side = 0; side < 4; ++side) {
    const LotFrame here = side_frame(block, side), next = side_frame(block, (side + 1) % 4);
    EXPECT_DOUBLE_EQ(here.plan_from_lot({side_length_m(block, side), 0}).x, next.corner.x);
    EXPECT_DOUBLE_EQ(here.plan_from_lot({side_length_m(block, side), 0}).y, next.corner.y);
  }
}

/// A rectangle in whole centimetres: plans lie on that grid, so that touching and overlapping are told apart exactly.
struct RectangleCm {
  std::int64_t west, south, east, north;
};

RectangleCm rectangle_cm(const LotFrame& lot, Point2d low_lot, Point2d high_lot) {
  Box2d box;
  box.add(lot.plan_from_lot(low_lot));
  box.add(lot.plan_from_lot(high_lot));
  const auto cm = [](double x_m) { return std::llround(100.0 * x_m); };
  return {cm(box.low.x), cm(box.low.y), cm(box.high.x), cm(box.high.y)};
}

/// The footprint as rectangles; a court belongs to its building.
std::vector<RectangleCm> rectangles_of(const BuildingPlan& p) {
  if (p.shape != FootprintShape::l_shape) return {rectangle_cm(p.lot, {0, 0}, {p.width_m, p.depth_m})};
  return {rectangle_cm(p.lot, {0, 0}, {p.width_m, p.wing_m}), rectangle_cm(p.lot, {0, p.wing_m}, {p.wing_m, p.depth_m})};
}

bool overlap(const RectangleCm& a, const RectangleCm& b) {
  return a.west < b.east && b.west < a.east && a.south < b.north && b.south < a.north;
}

bool overlap(const BuildingPlan& a, const BuildingPlan& b) {
  for (const RectangleCm& ra : rectangles_of(a))
    for (const RectangleCm& rb : rectangles_of(b))
      if (overlap(ra, rb)) return true;
  return false;
}

template <class Check>
void for_each_block(const CitySettings& settings, Check check_block) {
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) check_block(layout, layout.block_at(k));
}

std::vector<CitySettings> various_cities() {
  CitySettings plain, towers, narrow, wide, hillside;
  plain.size_m = 2000.0;
  towers.size_m = 700.0, towers.tower_share = 1.0, towers.seed = 5;
  narrow.size_m = 1200.0, narrow.avenue_spacing_m = narrow.street_spacing_m = 60.0;
  narrow.avenue_width_m = narrow.street_width_m = 15.0;
  wide.size_m = 3000.0, wide.avenue_spacing_m = 90.0, wide.street_spacing_m = 600.0, wide.seed = 9;
  hillside.size_m = 1500.0, hillside.hillside = true, hillside.seed = 3;
  return {plain, towers, narrow, wide, hillside};
}

TEST(BlockPlans, NoBuildingLeavesItsBlock) {
  for (const CitySettings& settings : various_cities())
    for_each_block(settings, [&](const CityLayout& layout, CityBlock block) {
      const Box2d box = layout.rectangle(block);
      const RectangleCm edge = rectangle_cm({{0, 0}, 0}, box.low, box.high);
      for (const BuildingPlan& plan : plans_of_block(settings, block))
        for (const RectangleCm& r : rectangles_of(plan))
          ASSERT_TRUE(r.west >= edge.west && r.south >= edge.south && r.east <= edge.east && r.north <= edge.north)
              << block.i << ' ' << block.j << " kind " << static_cast<int>(plan.kind);
    });
}

TEST(BlockPlans, NoTwoBuildingsOverlap) {
  for (const CitySettings& settings : various_cities())
    for_each_block(settings, [&](const CityLayout&, CityBlock block) {
      const std::vector<BuildingPlan> plans = plans_of_block(settings, block);
      for (std::size_t a = 0; a < plans.size(); ++a)
        for (std::size_t b = a + 1; b < plans.size(); ++b)
          ASSERT_FALSE(overlap(plans[a], plans[b])) << block.i << ' ' << block.j << ": " << a << " and " << b << " of kinds "
                                                    << static_cast<int>(plans[a].kind) << ' ' << static_cast<int>(plans[b].kind);
    });
}

TEST(BlockPlans, SomeBuildingsShareAWall) {
  const CitySettings settings = various_cities()[0];
  int touching = 0;
  for_each_block(settings, [&](const CityLayout&, CityBlock block) {
    const std::vector<BuildingPlan> plans = plans_of_block(settings, block);
    for (std::size_t a = 0; a + 1 < plans.size(); ++a) {
      const RectangleCm l = rectangles_of(plans[a])[0], r = rectangles_of(plans[a + 1])[0];
      touching += l.east == r.west || r.east == l.west || l.north == r.south || r.north == l.south ? 1 : 0;
    }
  });
  EXPECT_GT(touching, 100);
}

TEST(BlockPlans, DimensionsMakeSense) {
  for (const CitySettings& settings : various_cities())
    for_each_block(settings, [&](const CityLayout&, CityBlock block) {
      for (const BuildingPlan& p : plans_of_block(settings, block)) {
        const double narrower_m = std::min(p.width_m, p.depth_m);
        EXPECT_GT(narrower_m, 2.0);
        EXPECT_GT(p.wall_m, 2.0);
        EXPECT_LE(p.wall_m, settings.max_height_m);
        EXPECT_LT(p.roof_rise_m, p.roof == RoofShape::stepped ? 0.5 * p.wall_m : 0.6 * narrower_m + 3.0);
        if (p.shape == FootprintShape::l_shape) {
          EXPECT_LT(p.wing_m, narrower_m);
        }
        if (p.shape == FootprintShape::courtyard) {
          EXPECT_LT(2.0 * p.wing_m, narrower_m);
        }
      }
    });
}

TEST(BlockPlans, TowersHaveTheirShareOfTheCore) {
  for (const double share : {0.0, 0.25, 1.0}) {
    CitySettings settings{.size_m = 4000.0, .tower_share = share};
    double towers = 0.0, all = 0.0;
    for_each_block(settings, [&](const CityLayout& layout, CityBlock block) {
      const Box2d box = layout.rectangle(block);
      const bool core = UrbanField(settings).urbanity(0.5 * (box.low + box.high)) >= UrbanField::core_urbanity;
      for (const BuildingPlan& plan : plans_of_block(settings, block)) {
        const bool tower = plan.kind == BuildingKind::tower;
        if (!core) {
          EXPECT_FALSE(tower);
        }
        const bool park = plan.kind == BuildingKind::pavilion;
        towers += tower ? 1.0 : 0.0;
        all += core && !park ? 1.0 : 0.0;
      }
    });
    // Five standard deviations of a binomial count, none for never and always
    EXPECT_LE(std::abs(towers - share * all), 5.0 * std::sqrt(all * share * (1.0 - share))) << towers << " of " << all;
  }
}

TEST(BlockPlans, HillsidesHaveNoDetachedHouses) {
  int attached = 0;
  const CitySettings settings = various_cities()[4];
  for_each_block(settings, [&](const CityLayout&, CityBlock block) {
    for (const BuildingPlan& plan : plans_of_block(settings, block)) {
      EXPECT_NE(plan.kind, BuildingKind::detached);
      attached += plan.kind == BuildingKind::attached ? 1 : 0;
    }
  });
  EXPECT_GT(attached, 1000);
}

TEST(BlockPlans, OverhangsChangeNothingButGroundFloors) {
  CitySettings plain = various_cities()[0], overhanging = plain;
  overhanging.overhangs = true;
  int arcades = 0;
  for_each_block(plain, [&](const CityLayout&, CityBlock block) {
    const std::vector<BuildingPlan> before = plans_of_block(plain, block), after = plans_of_block(overhanging, block);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t k = 0; k < before.size(); ++k) {
      const auto key = [](const BuildingPlan& p) {
        return std::tuple(p.lot.corner.x, p.lot.corner.y, p.width_m, p.depth_m, p.wall_m, p.kind, p.shape, p.storeys);
      };
      EXPECT_EQ(key(before[k]), key(after[k]));
      EXPECT_EQ(before[k].arcade_depth_m, 0.0);
      if (after[k].arcade_depth_m > 0.0) {
        ++arcades;
        EXPECT_EQ(after[k].roof, RoofShape::flat);
      } else {
        EXPECT_EQ(before[k].roof, after[k].roof);
      }
    }
  });
  EXPECT_GT(arcades, 10);
}

TEST(BlockPlans, EveryKindOfBuildingOccurs) {
  CitySettings settings{.size_m = 5000.0};
  std::array<int, 9> seen{};
  for_each_block(settings, [&](const CityLayout&, CityBlock block) {
    for (const BuildingPlan& plan : plans_of_block(settings, block)) ++seen.at(static_cast<std::size_t>(plan.kind));
  });
  for (std::size_t kind = 0; kind < seen.size(); ++kind) EXPECT_GT(seen[kind], 0) << kind;
}

TEST(BlockPlans, BasesAreTheLowestGroundUnderTheCorners) {
  CitySettings settings{.size_m = 800.0, .terrain_relief_m = 60.0};
  const UrbanField field(settings);
  for_each_block(settings, [&](const CityLayout&, CityBlock block) {
    for (const BuildingPlan& plan : plans_of_block(settings, block)) {
      const Box2d box = plan_rectangle(plan);
      double lowest_m = settings.terrain_relief_m;
      for (const Point2d p : {box.low, box.high, Point2d{box.low.x, box.high.y}, Point2d{box.high.x, box.low.y}})
        lowest_m = std::min(lowest_m, field.ground_m(p));
      EXPECT_LE(base_m(field, plan), lowest_m);
      EXPECT_GT(base_m(field, plan), lowest_m - 0.01) << "more than the centimetre that rounding down takes";
    }
  });
}

CitySettings city_with_bridges(double relief_m) { return {.size_m = 2000.0, .terrain_relief_m = relief_m, .overhangs = true}; }

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

BuildingPlan house(Point2d corner, int side, double width_m, double depth_m) {
  return {.lot = {corner, side}, .width_m = width_m, .depth_m = depth_m};
}

TEST(TouchingWalls, SharedStretchesTouch) {
  const std::vector<BuildingPlan> plans{house({0, 0}, 0, 10, 8), house({10, 2}, 0, 6, 12), house({30, 0}, 0, 5, 5)};
  const TouchingWalls walls(plans);
  EXPECT_TRUE(walls.touches(0, {10, 0}, {10, 8}));
  EXPECT_TRUE(walls.touches(0, {10, 8}, {10, 0}));
  EXPECT_TRUE(walls.touches(1, {10, 2}, {10, 14}));
  EXPECT_FALSE(walls.touches(0, {0, 0}, {10, 0}));
  EXPECT_FALSE(walls.touches(0, {10, 0}, {10, 2})) << "below the neighbor's corner";
  EXPECT_FALSE(walls.touches(1, {10, 8}, {10, 14})) << "beyond the neighbor's corner";
  EXPECT_TRUE(walls.touches_any(0));
  EXPECT_TRUE(walls.touches_any(1));
  EXPECT_FALSE(walls.touches_any(2));
}

TEST(TouchingWalls, TheCentimetreDecides) {
  const std::vector<BuildingPlan> plans{house({0, 0}, 0, 10, 8), house({10.01, 0}, 0, 6, 8)};
  EXPECT_FALSE(TouchingWalls(plans).touches_any(0));
}

TEST(TouchingWalls, LotsOfAllSidesMeet) {
  // The second house faces east: its front runs from (10, 0) to (10, 8), and it lies to the west of it
  const std::vector<BuildingPlan> plans{house({10, 0}, 0, 5, 8), house({10, 0}, 1, 8, 6)};
  const TouchingWalls walls(plans);
  EXPECT_TRUE(walls.touches(0, {10, 0}, {10, 8}));
  EXPECT_TRUE(walls.touches(1, {10, 0}, {10, 8}));
}

}  // namespace
}  // namespace farlod
