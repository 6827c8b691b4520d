// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/block_site.hpp"

namespace farlod {
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
