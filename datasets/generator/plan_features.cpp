// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plan_features.hpp"

#include <algorithm>

#include "generator/block_site.hpp"
#include "generator/touching_walls.hpp"

namespace farlod {
namespace {

constexpr double divided_share = 0.3, third_part_share = 0.5;
constexpr double projecting_share = 0.35, least_projection_m = 0.5, largest_projection_m = 2.0;
/// The largest projection, as a share of the shorter side of the building.
constexpr double largest_projection_share = 0.2;
constexpr double highest_ground_floor_m = 4.2;
/// The edge of the third part, a shaft, and its height above the other parts.
constexpr double shaft_edge_m = 3.0, shaft_rise_m = 2.5;

[[nodiscard]] KeyedRandom random_of(const CitySettings& settings, RandomStream stream, CityBlock block, std::size_t building) {
  return KeyedRandom({settings.seed, key_of(stream), key_of(block.i), key_of(block.j), building});
}

/// A rectangle within the plan's rectangle, with a flat roof.
[[nodiscard]] BuildingPlan prism_part(const BuildingPlan& plan, Point2d low, Point2d high, double wall_m) {
  BuildingPlan part{.lot = moved(plan.lot, low.x, low.y), .kind = plan.kind};
  part.width_m = on_plan_grid_m(on_plan_grid_m(high.x) - on_plan_grid_m(low.x));
  part.depth_m = on_plan_grid_m(on_plan_grid_m(high.y) - on_plan_grid_m(low.y));
  part.wall_m = on_plan_grid_m(wall_m);
  return part;
}

/// A flat podium over the whole rectangle, and the tower through it.
[[nodiscard]] std::vector<BuildingPlan> podium_and_tower(KeyedRandom& random, const BuildingPlan& plan) {
  const double podium_share = random.between(0.25, 0.4);
  const double inset = random.between(0.15, 0.25);
  const Point2d low{inset * plan.width_m, inset * plan.depth_m}, high{plan.width_m - low.x, plan.depth_m - low.y};
  const BuildingPlan podium = prism_part(plan, {}, {plan.width_m, plan.depth_m}, podium_share * plan.wall_m);
  BuildingPlan tower = prism_part(plan, low, high, plan.wall_m);
  tower.roof = plan.roof;
  tower.roof_rise_m = plan.roof_rise_m;
  return {podium, tower};
}

/// A house without its right end, and in its place a lower annex that begins inside of the house.
[[nodiscard]] std::vector<BuildingPlan> house_and_annex(KeyedRandom& random, const BuildingPlan& plan) {
  const double house_m = random.between(0.6, 0.7) * plan.width_m;
  const double annex_m = random.between(0.35, 0.5) * plan.width_m;
  const double height_share = random.between(0.4, 0.8);
  BuildingPlan house = prism_part(plan, {}, {house_m, plan.depth_m}, plan.wall_m);
  house.roof = plan.roof;
  // The pitch does not change
  const double span_share = std::min(house.width_m, house.depth_m) / std::min(plan.width_m, plan.depth_m);
  house.roof_rise_m = on_plan_grid_m(span_share * plan.roof_rise_m);
  return {house, prism_part(plan, {annex_m, 0.2 * plan.depth_m}, {plan.width_m, 0.8 * plan.depth_m}, height_share * plan.wall_m)};
}

/// The shaft, inside of both other parts and higher than both.
[[nodiscard]] BuildingPlan shaft(const BuildingPlan& plan, Point2d middle) {
  const double half_m = 0.5 * shaft_edge_m;
  return prism_part(plan, {middle.x - half_m, middle.y - half_m}, {middle.x + half_m, middle.y + half_m},
                    plan.wall_m + (has_pitched_roof(plan) ? plan.roof_rise_m : 0.0) + shaft_rise_m);
}

[[nodiscard]] bool can_be_divided(const BuildingPlan& plan) {
  const bool house = plan.kind == BuildingKind::detached || plan.kind == BuildingKind::hall;
  const bool high = plan.kind == BuildingKind::office || plan.kind == BuildingKind::tower;
  return (house || high) && plan.shape == FootprintShape::rectangle && plan.arcade_depth_m == 0.0 &&
         std::min(plan.width_m, plan.depth_m) >= 8.0;
}

void divide(KeyedRandom& random, BuildingPlan& plan) {
  const bool podium = plan.kind == BuildingKind::office || plan.kind == BuildingKind::tower;
  std::vector<BuildingPlan> parts = podium ? podium_and_tower(random, plan) : house_and_annex(random, plan);
  const double middle_u_m = podium ? 0.5 * plan.width_m : 0.5 * plan.width_m + 0.05 * plan.width_m;
  if (random.chance(third_part_share)) parts.push_back(shaft(plan, {middle_u_m, 0.5 * plan.depth_m}));
  plan.parts = std::move(parts);
}

[[nodiscard]] bool can_project(const BuildingPlan& plan) {
  const bool kind = plan.kind == BuildingKind::attached || plan.kind == BuildingKind::office ||
                    plan.kind == BuildingKind::detached || plan.kind == BuildingKind::slab;
  return kind && plan.shape == FootprintShape::rectangle && plan.parts.empty() && plan.arcade_depth_m == 0.0 && plan.storeys >= 2;
}

}  // namespace

void divide_into_parts(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans) {
  if (!settings.overlapping_parts) return;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    KeyedRandom random = random_of(settings, RandomStream::building_parts, block, k);
    const bool drawn = random.chance(divided_share);
    if (drawn && can_be_divided(plans[k])) divide(random, plans[k]);
  }
}

void let_floors_project(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans) {
  if (!settings.projecting_floors) return;
  const TouchingWalls walls(plans);
  for (std::size_t k = 0; k < plans.size(); ++k) {
    BuildingPlan& plan = plans[k];
    KeyedRandom random = random_of(settings, RandomStream::projecting_floors, block, k);
    const bool drawn = random.chance(projecting_share);
    const double depth_m = on_plan_grid_m(random.between(least_projection_m, largest_projection_m));
    if (!drawn || !can_project(plan)) continue;
    (walls.touches_any(k) ? plan.arcade_depth_m : plan.projection_m) =
        std::min(depth_m, on_plan_grid_m(largest_projection_share * std::min(plan.width_m, plan.depth_m)));
    plan.arcade_height_m = std::min(highest_ground_floor_m, on_plan_grid_m(plan.wall_m / plan.storeys));
    plan.roof = RoofShape::flat;
    plan.roof_rise_m = 0.0;
  }
}

}  // namespace farlod
