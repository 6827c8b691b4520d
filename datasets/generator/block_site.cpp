// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/block_site.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/plan_solid.hpp"

namespace farlod {
namespace {

constexpr double storey_m = 3.1;
constexpr double lowest_arcaded_wall_m = 9.0, arcade_depth_m = 3.0, arcade_height_m = 4.2;

}  // namespace

std::vector<LotSpan> cut_into_lots(KeyedRandom& random, LotSpan side, double narrowest_m, double widest_m) {
  const double mean_m = 0.5 * (narrowest_m + widest_m);
  const int count = std::max(1, static_cast<int>(std::lround(side.width_m / mean_m)));
  const double even_m = side.width_m / count;
  const double shift_m = std::min(0.5 * (widest_m - narrowest_m), 0.4 * even_m);
  std::vector<LotSpan> lots;
  double begin_m = side.begin_m;
  for (int k = 1; k <= count; ++k) {
    const double draw = random.between(-0.5, 0.5);
    const double end_m = on_plan_grid_m(side.begin_m + k * even_m + (k < count ? draw * shift_m : 0.0));
    lots.push_back({begin_m, on_plan_grid_m(end_m - begin_m)});
    begin_m = end_m;
  }
  return lots;
}

LotFrame moved(const LotFrame& lot, double u_m, double v_m) {
  const Point2d corner = lot.plan_from_lot({on_plan_grid_m(u_m), on_plan_grid_m(v_m)});
  return {{on_plan_grid_m(corner.x), on_plan_grid_m(corner.y)}, lot.side};
}

void set_storeys(BlockSite& site, BuildingPlan& plan, int storeys) {
  const double parapet_m = site.random.between(0.2, 1.1);
  plan.storeys = storeys;
  plan.wall_m = on_plan_grid_m(site.settings.height_scale * (storeys * storey_m + parapet_m));
}

void set_pitched_roof(BlockSite& site, BuildingPlan& plan, double gabled_share) {
  const bool gabled = site.random.chance(gabled_share);
  const double pitch = site.random.between(0.6, 1.0);
  const double span_m = plan.shape == FootprintShape::l_shape ? plan.wing_m : std::min(plan.width_m, plan.depth_m);
  // An L has its own way of joining two ridges, with gables at both ends
  plan.roof = gabled || plan.shape == FootprintShape::l_shape ? RoofShape::gabled : RoofShape::hipped;
  plan.roof_rise_m = on_plan_grid_m(0.5 * span_m * pitch);
}

void maybe_add_arcade(BlockSite& site, BuildingPlan& plan, double share) {
  const bool drawn = site.random.chance(share);
  const bool possible =
      plan.shape == FootprintShape::rectangle && plan.wall_m >= lowest_arcaded_wall_m && plan.depth_m >= 3.0 * arcade_depth_m;
  if (!site.settings.overhangs || !drawn || !possible) return;
  plan.arcade_depth_m = arcade_depth_m;
  plan.arcade_height_m = arcade_height_m;
  plan.roof = RoofShape::flat;
  plan.roof_rise_m = 0.0;
}

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

/// With `overlapping_parts`: divides some buildings of a block into parts inside of the rectangle of the building. A tower or an
/// office becomes a podium and a tower that goes through it to the ground, sometimes with a lift tower inside of both. A house or
/// a hall becomes a shorter house and a lower annex that overlaps it, sometimes with a stair tower inside of both.
void divide_into_parts(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans) {
  if (!settings.overlapping_parts) return;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    KeyedRandom random = random_of(settings, RandomStream::building_parts, block, k);
    const bool drawn = random.chance(divided_share);
    if (drawn && can_be_divided(plans[k])) divide(random, plans[k]);
  }
}

/// With `projecting_floors`: the upper floors of some buildings without parts project by 0.5 to 2 m, on all sides if no other
/// building touches them, else on the side of the street. Their roofs become flat.
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

constexpr double park_share = 0.035, hall_share = 0.035, slab_share = 0.05;
/// Cities with fewer blocks have no park.
constexpr std::int64_t least_blocks_with_park = 9;
/// Closed street fronts need room for four corner buildings and those between them.
constexpr double least_edge_of_street_fronts_m = 48.0;
constexpr double fewest_urban = 0.1, mostly_urban = 0.28;

using BuildBlock = void (*)(BlockSite&);

/// Draws the kind of a block. A single random number decides, so that each kind has its share.
[[nodiscard]] BuildBlock draw_kind(BlockSite& site, const CityLayout& layout) {
  const double draw = site.random.unit();
  const double urban_draw = site.random.unit();
  const double u = site.urbanity;
  const bool roomy = std::min(site.width_m(), site.depth_m()) >= least_edge_of_street_fronts_m;
  if (draw < park_share && layout.block_count() >= least_blocks_with_park) return build_park;
  if (u >= UrbanField::core_urbanity) return build_core;
  if (site.settings.hillside) return roomy && urban_draw < 0.5 ? build_street_fronts : build_terraces;
  if (roomy && u < 0.35 && draw > 1.0 - hall_share) return build_halls;
  if (roomy && u > 0.06 && draw > 1.0 - hall_share - slab_share) return build_slabs;
  return roomy && urban_draw < smooth_step(fewest_urban, mostly_urban, u) ? build_street_fronts : build_detached_houses;
}

}  // namespace

Box2d plan_rectangle(const BuildingPlan& plan) {
  Box2d box;
  box.add(plan.lot.plan_from_lot({0.0, 0.0}));
  box.add(plan.lot.plan_from_lot({plan.width_m, plan.depth_m}));
  return box;
}

std::vector<Point2d> footprint_ring(const BuildingPlan& plan) {
  const double w = plan.width_m, d = plan.depth_m, t = plan.wing_m;
  if (plan.shape == FootprintShape::l_shape) return {{0, 0}, {w, 0}, {w, t}, {t, t}, {t, d}, {0, d}};
  return {{0, 0}, {w, 0}, {w, d}, {0, d}};
}

double base_m(const UrbanField& field, const BuildingPlan& plan) {
  const Box2d box = plan_rectangle(plan);
  const double south_m = std::min(field.ground_m(box.low), field.ground_m({box.high.x, box.low.y}));
  const double north_m = std::min(field.ground_m(box.high), field.ground_m({box.low.x, box.high.y}));
  return std::floor(std::min(south_m, north_m) * 100.0) / 100.0;
}

std::vector<BuildingPlan> plans_of_block(const CitySettings& settings, CityBlock block) {
  const CityLayout layout(settings);
  const Box2d rectangle = layout.rectangle(block);
  const Point2d centre = 0.5 * (rectangle.low + rectangle.high);
  BlockSite site{settings,
                 rectangle,
                 UrbanField(settings).urbanity(centre),
                 KeyedRandom({settings.seed, key_of(RandomStream::block), key_of(block.i), key_of(block.j)}),
                 {}};
  const BuildBlock build = draw_kind(site, layout);
  build(site);
  divide_into_parts(settings, block, site.plans);
  let_floors_project(settings, block, site.plans);
  return std::move(site.plans);
}

namespace {

constexpr double bridge_width_m = 3.5, bridge_height_m = 3.2, least_clearance_m = 5.0;
/// The least width of wall to either side of a bridge.
constexpr double shoulder_m = 1.5;
constexpr double share_across_street = 0.5, share_across_avenue = 0.2;

/// The direction from a block to its neighbor: which coordinate the bridge runs along.
enum class Across { street, avenue };

/// A façade along a street: its extent along the street, and its position across the street.
struct Facade {
  double low_m, high_m, facade_m;
  double ground_m, top_m;
};

/// The straight street fronts of a block along one of its borders, from west to east or from south to north.
[[nodiscard]] std::vector<Facade> facades(const CitySettings& settings, CityBlock block, Across across, bool far_side) {
  const CityLayout layout(settings);
  const UrbanField field(settings);
  const Box2d border = layout.rectangle(block);
  const bool north_south = across == Across::street;
  const double border_m = north_south ? (far_side ? border.high.y : border.low.y) : (far_side ? border.high.x : border.low.x);
  std::vector<Facade> result;
  for (const BuildingPlan& plan : plans_of_block(settings, block)) {
    const Box2d box = plan_rectangle(plan);
    const double facade_m = north_south ? (far_side ? box.high.y : box.low.y) : (far_side ? box.high.x : box.low.x);
    // Legs of an L and parts may lie behind the border of the rectangle
    if (plan.shape == FootprintShape::l_shape || !plan.parts.empty() || on_plan_grid_m(facade_m - border_m) != 0.0) continue;
    const double ground_m = base_m(field, plan);
    result.push_back(
        {north_south ? box.low.x : box.low.y, north_south ? box.high.x : box.high.y, facade_m, ground_m, ground_m + plan.wall_m});
  }
  return result;
}

[[nodiscard]] double highest_ground_m(const UrbanField& field, const Box2d& box) {
  const double south_m = std::max(field.ground_m(box.low), field.ground_m({box.high.x, box.low.y}));
  const double north_m = std::max(field.ground_m(box.high), field.ground_m({box.low.x, box.high.y}));
  return std::max(south_m, north_m);
}

/// A bridge between two façades, if the part along which they face each other is long enough and both are tall enough.
[[nodiscard]] std::optional<BuildingPlan> bridge_between(const UrbanField& field, const Facade& near, const Facade& far,
                                                         Across across) {
  const double low_m = std::max(near.low_m, far.low_m) + shoulder_m;
  const double high_m = std::min(near.high_m, far.high_m) - shoulder_m;
  if (high_m - low_m < bridge_width_m) return std::nullopt;
  const double begin_m = on_plan_grid_m(0.5 * (low_m + high_m - bridge_width_m));
  const double span_m = on_plan_grid_m(far.facade_m - near.facade_m);
  BuildingPlan bridge;
  bridge.lot = across == Across::street ? LotFrame{{begin_m, near.facade_m}, 0} : LotFrame{{near.facade_m, begin_m}, 0};
  bridge.width_m = across == Across::street ? bridge_width_m : span_m;
  bridge.depth_m = across == Across::street ? span_m : bridge_width_m;
  // On a slope, the street may be higher than both bases, which are those of the lowest corners
  const double street_m = highest_ground_m(field, plan_rectangle(bridge));
  const double underside_m = std::max({near.ground_m, far.ground_m, street_m}) + least_clearance_m;
  const double ground_m = base_m(field, bridge);
  bridge.clearance_m = std::ceil(100.0 * (underside_m - ground_m)) / 100.0;
  bridge.wall_m = on_plan_grid_m(bridge.clearance_m + bridge_height_m);
  if (ground_m + bridge.wall_m > std::min(near.top_m, far.top_m)) return std::nullopt;
  bridge.kind = BuildingKind::bridge;
  return bridge;
}

void add_bridge(const CitySettings& settings, CityBlock block, Across across, std::vector<BuildingPlan>& bridges) {
  const CityBlock neighbor = across == Across::street ? CityBlock{block.i, block.j + 1} : CityBlock{block.i + 1, block.j};
  if (!CityLayout(settings).contains(neighbor)) return;
  KeyedRandom random(
      {settings.seed, key_of(RandomStream::bridges), key_of(block.i), key_of(block.j), static_cast<std::uint64_t>(across)});
  if (!random.chance(across == Across::street ? share_across_street : share_across_avenue)) return;
  const UrbanField field(settings);
  std::vector<BuildingPlan> possible;
  const std::vector<Facade> far_facades = facades(settings, neighbor, across, false);
  for (const Facade& near : facades(settings, block, across, true))
    for (const Facade& far : far_facades)
      if (const auto bridge = bridge_between(field, near, far, across)) possible.push_back(*bridge);
  if (possible.empty()) return;
  bridges.push_back(possible[static_cast<std::size_t>(random.whole(0, static_cast<int>(possible.size()) - 1))]);
}

}  // namespace

std::vector<BuildingPlan> bridges_of_block(const CitySettings& settings, CityBlock block) {
  std::vector<BuildingPlan> bridges;
  if (!settings.overhangs) return bridges;
  add_bridge(settings, block, Across::street, bridges);
  add_bridge(settings, block, Across::avenue, bridges);
  return bridges;
}

}  // namespace farlod
