// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "generator/block_site.hpp"

namespace farlod {
namespace {

/// Blocks shallower than this have one row of lots instead of two, back to back.
constexpr double least_depth_of_two_rows_m = 44.0;
/// Shares of lots, and of houses.
constexpr double empty_lot_share = 0.06, pair_share = 0.25, l_share = 0.2, outbuilding_share = 0.45, gap_share = 0.04;
constexpr double flat_house_share = 0.1, flat_front_share = 0.25;
/// The share of houses of a terrace that are followed by a gap.
constexpr double terrace_gap_share = 0.08;

/// A row of lots along one side of a block.
struct LotRow {
  LotFrame frame;
  double depth_m;
};

[[nodiscard]] std::vector<LotRow> rows_of(const BlockSite& site) {
  const int side = site.long_side();
  const double depth_m = side_length_m(site.rectangle, side + 1);
  if (depth_m < least_depth_of_two_rows_m) return {{side_frame(site.rectangle, side), depth_m}};
  const double half_m = 0.5 * depth_m;
  return {{side_frame(site.rectangle, side), half_m}, {side_frame(site.rectangle, side + 2), half_m}};
}

/// The place of a house in its lot. The two houses of a pair touch at the border of their lots.
enum class Placing { middle, against_next, against_previous };

[[nodiscard]] double left_margin_m(BlockSite& site, Placing placing, double spare_m) {
  const double middle = site.random.between(0.35, 0.65);
  if (placing == Placing::against_next) return spare_m;
  return placing == Placing::against_previous ? 0.0 : on_plan_grid_m(middle * spare_m);
}

/// A garage or shed behind a house, where there is room for it.
void maybe_add_outbuilding(BlockSite& site, const LotRow& row, const LotSpan& lot, double behind_m) {
  const bool drawn = site.random.chance(outbuilding_share);
  const double width_m = on_plan_grid_m(site.random.between(3.0, 5.5));
  const double depth_m = on_plan_grid_m(site.random.between(3.5, 6.5));
  const double begin_m = lot.begin_m + 1.0, back_m = behind_m + 1.5;
  if (!drawn || width_m > lot.width_m - 2.0 || back_m + depth_m > row.depth_m - 0.5) return;
  BuildingPlan shed{.lot = moved(row.frame, begin_m, back_m), .width_m = width_m, .depth_m = depth_m};
  shed.wall_m = on_plan_grid_m(site.random.between(2.3, 3.2));
  shed.kind = BuildingKind::outbuilding;
  site.plans.push_back(shed);
}

void shape_house(BlockSite& site, BuildingPlan& house, bool may_be_l) {
  const bool l_drawn = site.random.chance(l_share);
  const double wing_m = on_plan_grid_m(site.random.between(4.5, 5.5));
  if (may_be_l && l_drawn && std::min(house.width_m, house.depth_m) >= wing_m + 3.0) {
    house.shape = FootprintShape::l_shape;
    house.wing_m = wing_m;
  }
  const int tallest = site.urbanity > 0.15 ? 3 : 2;
  set_storeys(site, house, site.random.whole(1, tallest));
  const bool flat = site.random.chance(flat_house_share);
  set_pitched_roof(site, house, 0.65);
  if (flat) house.roof = RoofShape::flat, house.roof_rise_m = 0.0;
}

void add_house(BlockSite& site, const LotRow& row, const LotSpan& lot, Placing placing) {
  const double garden_m = on_plan_grid_m(site.random.between(3.0, 6.0));
  const double wish_width_m = on_plan_grid_m(site.random.between(8.0, 12.5));
  const double wish_depth_m = on_plan_grid_m(site.random.between(8.5, 12.5));
  BuildingPlan house;
  house.width_m = std::min(wish_width_m, on_plan_grid_m(lot.width_m - 3.0));
  house.depth_m = std::min(wish_depth_m, on_plan_grid_m(row.depth_m - garden_m - 2.0));
  house.kind = placing == Placing::middle ? BuildingKind::detached : BuildingKind::attached;
  const double spare_m = on_plan_grid_m(lot.width_m - house.width_m);
  house.lot = moved(row.frame, lot.begin_m + left_margin_m(site, placing, spare_m), garden_m);
  shape_house(site, house, placing == Placing::middle);
  if (house.width_m < 5.0 || house.depth_m < 5.0) return;
  site.plans.push_back(house);
  maybe_add_outbuilding(site, row, lot, garden_m + house.depth_m);
}

/// The lengths of a corner building along the side that starts at its corner and along the side that ends there.
struct CornerSize {
  double along_m, back_m;
};

void add_corner(BlockSite& site, int side, CornerSize size, double wing_m, int storeys) {
  BuildingPlan corner{.lot = side_frame(site.rectangle, side), .width_m = size.along_m, .depth_m = size.back_m};
  corner.shape = FootprintShape::l_shape;
  corner.wing_m = wing_m;
  corner.kind = BuildingKind::attached;
  set_storeys(site, corner, storeys);
  set_pitched_roof(site, corner, 1.0);
  site.plans.push_back(corner);
}

void add_front_building(BlockSite& site, const LotFrame& side, const LotSpan& lot, int storeys) {
  BuildingPlan house{.lot = moved(side, lot.begin_m, 0.0), .width_m = lot.width_m};
  house.depth_m = on_plan_grid_m(site.random.between(10.0, 13.0));
  house.kind = BuildingKind::attached;
  const int difference = site.random.whole(-1, 1);
  set_storeys(site, house, std::max(2, storeys + difference));
  const bool flat = site.random.chance(flat_front_share);
  set_pitched_roof(site, house, 1.0);
  if (flat) house.roof = RoofShape::flat, house.roof_rise_m = 0.0;
  maybe_add_arcade(site, house, 0.12);
  const bool gap = site.random.chance(gap_share);
  if (!gap) site.plans.push_back(house);
}

/// Sheds and workshops in the yard, away from the fronts of the shorter sides.
void add_yard_building(BlockSite& site, const LotFrame& side, const LotSpan& lot, double half_depth_m) {
  constexpr double deepest_front_m = 13.0;
  maybe_add_outbuilding(site, {side, half_depth_m}, lot, deepest_front_m);
}

}  // namespace

void build_detached_houses(BlockSite& site) {
  for (const LotRow& row : rows_of(site)) {
    const double length_m = side_length_m(site.rectangle, row.frame.side);
    Placing next = Placing::middle;
    const std::vector<LotSpan> lots = cut_into_lots(site.random, {0.0, length_m}, 12.5, 17.5);
    for (std::size_t k = 0; k < lots.size(); ++k) {
      const bool empty = site.random.chance(empty_lot_share);
      const bool pair = site.random.chance(pair_share);
      Placing placing = next;
      next = Placing::middle;
      if (placing == Placing::middle && pair && k + 1 < lots.size()) {
        placing = Placing::against_next;
        next = Placing::against_previous;
      }
      if (!empty) add_house(site, row, lots[k], placing);
    }
  }
}

void build_terraces(BlockSite& site) {
  for (const LotRow& row : rows_of(site)) {
    const double length_m = side_length_m(site.rectangle, row.frame.side);
    const double garden_m = on_plan_grid_m(site.random.between(2.0, 5.0));
    const double widest_depth_m = on_plan_grid_m(row.depth_m - garden_m - 2.0);
    const double depth_m = std::min(on_plan_grid_m(site.random.between(8.5, 11.5)), widest_depth_m);
    for (const LotSpan& lot : cut_into_lots(site.random, {0.0, length_m}, 6.0, 9.5)) {
      BuildingPlan house{.lot = moved(row.frame, lot.begin_m, garden_m), .width_m = lot.width_m, .depth_m = depth_m};
      house.kind = BuildingKind::attached;
      set_storeys(site, house, site.random.whole(2, 3));
      const bool flat = site.random.chance(flat_house_share);
      set_pitched_roof(site, house, 1.0);
      if (flat) house.roof = RoofShape::flat, house.roof_rise_m = 0.0;
      const bool gap = site.random.chance(terrace_gap_share);
      if (!gap && depth_m >= 5.0) site.plans.push_back(house);
    }
  }
}

void build_street_fronts(BlockSite& site) {
  const double wing_m = on_plan_grid_m(site.random.between(10.0, 12.5));
  const int storeys = std::clamp(static_cast<int>(2.0 + 6.0 * site.urbanity), 2, 7);
  // Corners first: the rows fill the space between them
  CornerSize corners[4];
  for (int side = 0; side < 4; ++side) {
    corners[side].along_m = on_plan_grid_m(site.random.between(16.0, 20.0));
    corners[side].back_m = on_plan_grid_m(site.random.between(16.0, 20.0));
    add_corner(site, side, corners[side], wing_m, storeys + 1);
  }
  for (int side = 0; side < 4; ++side) {
    const LotFrame frame = side_frame(site.rectangle, side);
    const double begin_m = corners[side].along_m;
    const double end_m = on_plan_grid_m(side_length_m(site.rectangle, side) - corners[(side + 1) % 4].back_m);
    const bool has_yard = side % 2 == site.long_side();
    for (const LotSpan& lot : cut_into_lots(site.random, {begin_m, end_m - begin_m}, 8.0, 12.5)) {
      add_front_building(site, frame, lot, storeys);
      const bool clear_of_sides = lot.begin_m > 21.0 && lot.begin_m + lot.width_m < side_length_m(site.rectangle, side) - 21.0;
      if (has_yard && clear_of_sides) add_yard_building(site, frame, lot, 0.5 * side_length_m(site.rectangle, side + 1));
    }
  }
}

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
