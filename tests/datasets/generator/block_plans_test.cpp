// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <tuple>

#include "generator/building_plan.hpp"

namespace farlod {
namespace {

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
    CitySettings settings;
    settings.size_m = 4000.0;
    settings.tower_share = share;
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
  CitySettings settings;
  settings.size_m = 5000.0;
  std::array<int, 9> seen{};
  for_each_block(settings, [&](const CityLayout&, CityBlock block) {
    for (const BuildingPlan& plan : plans_of_block(settings, block)) ++seen.at(static_cast<std::size_t>(plan.kind));
  });
  for (std::size_t kind = 0; kind < seen.size(); ++kind) EXPECT_GT(seen[kind], 0) << kind;
}

TEST(BlockPlans, BasesAreTheLowestGroundUnderTheCorners) {
  CitySettings settings;
  settings.size_m = 800.0;
  settings.terrain_relief_m = 60.0;
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

}  // namespace
}  // namespace farlod
