// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/balconies.hpp"

#include <fmt/format.h>

#include <utility>

#include "generator/solid_builder.hpp"

namespace farlod {
namespace {

constexpr double share_with_balconies = 0.4;
constexpr double slab_width_m = 3.0, slab_depth_m = 1.2, slab_thickness_m = 0.2, least_bay_m = 4.5;

[[nodiscard]] bool can_have_balconies(const BuildingPlan& plan) {
  const bool flats = plan.kind == BuildingKind::attached || plan.kind == BuildingKind::slab;
  return flats && plan.shape == FootprintShape::rectangle && plan.storeys >= 2 && plan.arcade_depth_m == 0.0 &&
         plan.projection_m == 0.0 && plan.width_m >= least_bay_m;
}

/// A slab whose top is at `floor_m`, from corner to corner in the lot's frame.
[[nodiscard]] PlanSolid slab(const BuildingPlan& plan, double ground_m, Point2d low, Point2d high, double floor_m) {
  const LotRing ring{low, {high.x, low.y}, high, {low.x, high.y}};
  const double underside_m = on_plan_grid_m(floor_m - slab_thickness_m);
  SolidBuilder solid(plan.lot, ground_m);
  solid.add_cap(FacetRole::outer_ceiling, ring, underside_m);
  solid.add_walls(ring, underside_m, floor_m);
  solid.add_cap(FacetRole::roof, ring, floor_m);
  PlanSolid result = solid.finish();
  result.kind = ComponentKind::installation;
  return result;
}

}  // namespace

void maybe_add_balconies(KeyedRandom& random, const BuildingPlan& plan, const TouchingWalls& walls, std::size_t row,
                         PlanBuilding& building) {
  const bool drawn = random.chance(share_with_balconies);
  const bool rear = random.chance(0.5);
  const double wall_v_m = rear ? plan.depth_m : 0.0;
  const LotFrame& lot = plan.lot;
  if (!drawn || !can_have_balconies(plan)) return;
  if (walls.touches(row, lot.plan_from_lot({0.0, wall_v_m}), lot.plan_from_lot({plan.width_m, wall_v_m}))) return;
  const int bays = static_cast<int>(plan.width_m / least_bay_m);
  const double low_v_m = rear ? wall_v_m : -slab_depth_m, ground_m = building.solids.front().ground_m;
  for (int storey = 1; storey < plan.storeys; ++storey)
    for (int bay = 0; bay < bays; ++bay) {
      const double floor_m = on_plan_grid_m(storey * plan.wall_m / plan.storeys);
      const double begin_m = on_plan_grid_m((bay + 0.5) * plan.width_m / bays - 0.5 * slab_width_m);
      PlanSolid balcony = slab(plan, ground_m, {begin_m, low_v_m}, {begin_m + slab_width_m, low_v_m + slab_depth_m}, floor_m);
      balcony.suffix = fmt::format("_balcony_{}_{}", storey, bay);
      building.solids.push_back(std::move(balcony));
    }
}

}  // namespace farlod
