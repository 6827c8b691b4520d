// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "generator/block_site.hpp"

namespace farlod {
namespace {

constexpr double courtyard_share = 0.35, pavilion_share = 0.6, stepped_share = 0.6;
constexpr double lowest_tower_m = 50.0;
/// The least width of a court.
constexpr double least_court_m = 8.0;

/// 0 at the border of the core, 1 in its centre.
[[nodiscard]] double depth_into_core(double urbanity) {
  return std::clamp((urbanity - UrbanField::core_urbanity) / (1.0 - UrbanField::core_urbanity), 0.0, 1.0);
}

[[nodiscard]] double draw_tower_height_m(BlockSite& site) {
  // Several towers reach the full height, so that the tallest of a city does not depend on a single random number
  const double share = std::min(1.0, site.random.between(0.25, 1.1));
  const double strength = 0.3 + 0.7 * depth_into_core(site.urbanity);
  return on_plan_grid_m(lowest_tower_m + (site.settings.max_height_m - lowest_tower_m) * share * strength);
}

/// A tower on a plaza in the middle of its lot.
[[nodiscard]] BuildingPlan draw_tower(BlockSite& site, const LotFrame& frame, const LotSpan& lot, double lot_depth_m) {
  const double wish_width_m = on_plan_grid_m(site.random.between(20.0, 34.0));
  const double wish_depth_m = on_plan_grid_m(site.random.between(20.0, 30.0));
  BuildingPlan tower;
  tower.width_m = std::min(wish_width_m, on_plan_grid_m(lot.width_m - 4.0));
  tower.depth_m = std::min(wish_depth_m, on_plan_grid_m(lot_depth_m - 4.0));
  tower.lot = moved(frame, lot.begin_m + 0.5 * (lot.width_m - tower.width_m), 0.5 * (lot_depth_m - tower.depth_m));
  tower.wall_m = draw_tower_height_m(site);
  tower.storeys = static_cast<int>(tower.wall_m / 3.6);
  tower.kind = BuildingKind::tower;
  const bool stepped = site.random.chance(stepped_share);
  const double top_share = site.random.between(0.1, 0.35);
  if (stepped) tower.roof = RoofShape::stepped, tower.roof_rise_m = on_plan_grid_m(top_share * tower.wall_m);
  return tower;
}

[[nodiscard]] int draw_office_storeys(BlockSite& site) {
  const int storeys = site.random.whole(5, 9);
  return storeys + static_cast<int>(6.0 * depth_into_core(site.urbanity));
}

/// An office or block of flats over the whole width of its lot, so that the street front is closed.
[[nodiscard]] BuildingPlan draw_office(BlockSite& site, const LotFrame& frame, const LotSpan& lot, double lot_depth_m) {
  const double fill = site.random.between(0.55, 0.95);
  const double wing_m = on_plan_grid_m(site.random.between(13.0, 15.0));
  const bool l_drawn = site.random.chance(0.3);
  BuildingPlan office{.lot = moved(frame, lot.begin_m, 0.0), .width_m = lot.width_m};
  office.depth_m = on_plan_grid_m(fill * lot_depth_m);
  office.kind = BuildingKind::office;
  if (l_drawn && std::min(office.width_m, office.depth_m) >= wing_m + 5.0) {
    office.shape = FootprintShape::l_shape;
    office.wing_m = wing_m;
  }
  set_storeys(site, office, draw_office_storeys(site));
  maybe_add_arcade(site, office, 0.35);
  return office;
}

/// Four wings around a court, over the whole depth of the block.
[[nodiscard]] BuildingPlan draw_courtyard(BlockSite& site, const LotFrame& frame, const LotSpan& lot, double depth_m) {
  BuildingPlan plan{.lot = moved(frame, lot.begin_m, 0.0), .width_m = lot.width_m, .depth_m = depth_m};
  const double wish_wing_m = on_plan_grid_m(site.random.between(11.0, 15.0));
  const double widest_m = on_plan_grid_m(0.5 * (std::min(plan.width_m, plan.depth_m) - least_court_m));
  plan.kind = BuildingKind::courtyard;
  if (widest_m >= 5.0) {
    plan.shape = FootprintShape::courtyard;
    plan.wing_m = std::min(wish_wing_m, widest_m);
  }
  set_storeys(site, plan, draw_office_storeys(site));
  return plan;
}

/// Adds a tower with the probability of the settings, and another building of the core otherwise.
void add_core_lot(BlockSite& site, const LotFrame& frame, const LotSpan& lot, double lot_depth_m, bool courtyard) {
  const bool is_tower = site.random.chance(site.settings.tower_share);
  const BuildingPlan tower = draw_tower(site, frame, lot, lot_depth_m);
  const BuildingPlan other =
      courtyard ? draw_courtyard(site, frame, lot, lot_depth_m) : draw_office(site, frame, lot, lot_depth_m);
  site.plans.push_back(is_tower ? tower : other);
}

/// A free-standing building in the middle of its lot, with `margin_m` around it; nothing on a lot that is too small.
void add_with_margin(BlockSite& site, const LotSpan& lot, double margin_m, BuildingPlan plan) {
  const LotFrame frame = side_frame(site.rectangle, site.long_side());
  plan.lot = moved(frame, lot.begin_m + margin_m, margin_m);
  plan.width_m = on_plan_grid_m(lot.width_m - 2.0 * margin_m);
  plan.depth_m = on_plan_grid_m(side_length_m(site.rectangle, site.long_side() + 1) - 2.0 * margin_m);
  if (std::min(plan.width_m, plan.depth_m) >= 5.0) site.plans.push_back(plan);
}

}  // namespace

void build_core(BlockSite& site) {
  const int side = site.long_side();
  const double length_m = side_length_m(site.rectangle, side);
  const double depth_m = side_length_m(site.rectangle, side + 1);
  for (const LotSpan& lot : cut_into_lots(site.random, {0.0, length_m}, 24.0, 38.0)) {
    const bool courtyard = site.random.chance(courtyard_share);
    const LotFrame front = side_frame(site.rectangle, side);
    if (courtyard) {
      add_core_lot(site, front, lot, depth_m, true);
      continue;
    }
    const LotSpan opposite{on_plan_grid_m(length_m - lot.begin_m - lot.width_m), lot.width_m};
    add_core_lot(site, front, lot, 0.5 * depth_m, false);
    add_core_lot(site, side_frame(site.rectangle, side + 2), opposite, 0.5 * depth_m, false);
  }
}

void build_slabs(BlockSite& site) {
  const double length_m = side_length_m(site.rectangle, site.long_side());
  const int storeys = site.random.whole(5, 12);
  for (const LotSpan& lot : cut_into_lots(site.random, {0.0, length_m}, 29.0, 31.0)) {
    BuildingPlan slab;
    slab.kind = BuildingKind::slab;
    set_storeys(site, slab, storeys);
    add_with_margin(site, lot, 8.5, slab);
  }
}

void build_halls(BlockSite& site) {
  const double length_m = side_length_m(site.rectangle, site.long_side());
  for (const LotSpan& lot : cut_into_lots(site.random, {0.0, length_m}, 45.0, 75.0)) {
    BuildingPlan hall;
    hall.kind = BuildingKind::hall;
    hall.wall_m = on_plan_grid_m(site.settings.height_scale * site.random.between(6.5, 12.0));
    add_with_margin(site, lot, 6.0, hall);
  }
}

void build_park(BlockSite& site) {
  const bool drawn = site.random.chance(pavilion_share);
  const double edge_m = on_plan_grid_m(site.random.between(6.0, 10.0));
  const double u = site.random.between(0.2, 0.7);
  const double v = site.random.between(0.2, 0.7);
  if (!drawn || edge_m > 0.3 * std::min(site.width_m(), site.depth_m())) return;
  BuildingPlan pavilion{.lot = moved(side_frame(site.rectangle, 0), u * site.width_m(), v * site.depth_m()),
                        .width_m = edge_m,
                        .depth_m = on_plan_grid_m(1.2 * edge_m),
                        .kind = BuildingKind::pavilion};
  set_storeys(site, pavilion, 1);
  set_pitched_roof(site, pavilion, 0.0);
  if (v * site.depth_m() + pavilion.depth_m <= site.depth_m()) site.plans.push_back(pavilion);
}

}  // namespace farlod
