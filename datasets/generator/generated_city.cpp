// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/generated_city.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "farlod/error.hpp"
#include "generator/building_details.hpp"
#include "generator/building_solid.hpp"
#include "generator/keyed_random.hpp"
#include "generator/plan_solid.hpp"

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

/// Decides at random whether a building gets balconies, and adds them to its street front or its rear: closed boxes, one for each
/// storey and bay from the second storey upwards, as installations. Only street fronts, terraces and slabs of flats have them.
/// `row` is the number of the building in the block.
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

/// The widest eaves of the steepest roof reach 1.25 m down. Above lower walls they could touch the ground.
constexpr double lowest_wall_with_eaves_m = 2.0;
constexpr double least_error_m = 10.0, largest_error_m = 40.0, share_at_zero = 0.5;

/// The overhangs of a roof. It does not project over a wall that a neighbor touches.
[[nodiscard]] Overhangs overhangs_of(const CitySettings& settings, const TouchingWalls& walls, std::size_t row,
                                     const BuildingPlan& plan) {
  Overhangs overhangs{};
  if (settings.eaves_m == 0.0 || !has_pitched_roof(plan) || plan.wall_m < lowest_wall_with_eaves_m) return overhangs;
  const std::vector<Point2d> ring = footprint_ring(plan);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d a = plan.lot.plan_from_lot(ring[k]), b = plan.lot.plan_from_lot(ring[(k + 1) % ring.size()]);
    if (!walls.touches(row, a, b)) overhangs[k] = settings.eaves_m;
  }
  return overhangs;
}

/// Lowers the base of all components that stand on the ground.
void lower_base(PlanBuilding& building, double by_m) {
  for (PlanSolid& solid : building.solids) {
    if (solid.kind == ComponentKind::installation) continue;
    for (PlanFacet& facet : solid.facets)
      for (PlanRing* ring : {&facet.outer, &facet.hole})
        for (Point3d& p : *ring)
          if (p.z == 0.0) p.z = -by_m;
  }
}

void maybe_lower_base(KeyedRandom random, double share, PlanBuilding& building) {
  const bool drawn = random.chance(share), at_zero = random.chance(share_at_zero);
  const double error_m = on_plan_grid_m(random.between(least_error_m, largest_error_m));
  const double ground_m = building.solids.front().ground_m;
  // On ground near z = 0, a base at z = 0 would hardly be an error
  if (drawn) lower_base(building, at_zero && ground_m >= least_error_m ? ground_m : error_m);
}

/// Raises the buildings of one block.
class BlockRaiser {
 public:
  BlockRaiser(const CitySettings& settings, CityBlock block)
      : settings_(settings), block_(block), field_(settings), plans_(plans_of_block(settings, block)), walls_(plans_) {}

  [[nodiscard]] std::vector<PlanBuilding> buildings() const {
    std::vector<PlanBuilding> result;
    for (std::size_t row = 0; row < plans_.size(); ++row) result.push_back(building(row));
    if (settings_.open_shells) open_shells(result);
    const std::vector<BuildingPlan> bridges = bridges_of_block(settings_, block_);
    for (std::size_t k = 0; k < bridges.size(); ++k) {
      result.push_back(named("bridge", k, bridges[k]));
      result.back().solids.push_back(raise(bridges[k], base_m(field_, bridges[k]), settings_.lod));
    }
    return result;
  }

 private:
  [[nodiscard]] PlanBuilding named(std::string_view prefix, std::size_t row, const BuildingPlan& plan) const {
    return {.id = fmt::format("{}_{}_{}_{}", prefix, block_.i, block_.j, row), .kind = plan.kind, .storeys = plan.storeys};
  }

  [[nodiscard]] KeyedRandom random(RandomStream stream, std::size_t row) const {
    return KeyedRandom({settings_.seed, key_of(stream), key_of(block_.i), key_of(block_.j), row});
  }

  [[nodiscard]] PlanBuilding building(std::size_t row) const {
    const BuildingPlan& plan = plans_[row];
    PlanBuilding building = named("building", row, plan);
    const double ground_m = base_m(field_, plan);
    if (plan.parts.empty()) {
      building.solids.push_back(raise(plan, ground_m, settings_.lod, overhangs_of(settings_, walls_, row, plan)));
      add_details(row, building);
    }
    for (const BuildingPlan& part : plan.parts) {
      building.solids.push_back(raise(part, ground_m, settings_.lod, overhangs_of(settings_, walls_, row, part)));
      building.solids.back().kind = ComponentKind::part;
      building.solids.back().suffix = fmt::format("_part_{}", building.solids.size());
    }
    if (settings_.wrong_base_share > 0.0)
      maybe_lower_base(random(RandomStream::wrong_base, row), settings_.wrong_base_share, building);
    return building;
  }

  void add_details(std::size_t row, PlanBuilding& building) const {
    const BuildingPlan& plan = plans_[row];
    const bool has_windows =
        plan.kind != BuildingKind::tower && plan.kind != BuildingKind::outbuilding && plan.kind != BuildingKind::hall;
    KeyedRandom facade = random(RandomStream::facade, row), balconies = random(RandomStream::balconies, row);
    if (settings_.facade_details && has_windows) {
      add_openings(facade, plan, walls_, row, building.solids.front());
      maybe_add_roof_installations(facade, plan, building);
    }
    if (settings_.balconies) maybe_add_balconies(balconies, plan, walls_, row, building);
  }

  const CitySettings& settings_;
  CityBlock block_;
  UrbanField field_;
  std::vector<BuildingPlan> plans_;
  TouchingWalls walls_;
};

/// The buildings of a block as solids with the features of the settings, followed by the bridges that start from the block.
std::vector<PlanBuilding> raise_block(const CitySettings& settings, CityBlock block) {
  return BlockRaiser(settings, block).buildings();
}

/// The number of evenly spread blocks from which the buildings of a city are estimated.
constexpr std::int64_t counted_blocks = 1500;

[[nodiscard]] double estimated_buildings(const CitySettings& settings) {
  const CityLayout layout(settings);
  const std::int64_t all = layout.block_count(), samples = std::min(all, counted_blocks);
  std::size_t found = 0;
  for (std::int64_t k = 0; k < samples; ++k) found += plans_of_block(settings, layout.block_at(k * all / samples)).size();
  return static_cast<double>(found) * static_cast<double>(all) / static_cast<double>(samples);
}

}  // namespace

std::vector<GeneratedBuilding> buildings_of_block(const CitySettings& settings, CityBlock block) {
  const PlanRotation rotation(settings.rotation_deg);
  std::vector<GeneratedBuilding> result;
  for (const PlanBuilding& building : raise_block(settings, block)) result.push_back(in_city(building, rotation));
  return result;
}

void visit_city(const CitySettings& settings, const CityVisitor& visitor) {
  check(settings);
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    for (const GeneratedBuilding& building : buildings_of_block(settings, layout.block_at(k))) visitor.building(building);
    visitor.block_done(k + 1);
  }
}

double size_for_buildings_m(CitySettings settings, std::int64_t buildings) {
  const auto count_at = [&settings](double size_m) {
    settings.size_m = size_m;
    return estimated_buildings(settings);
  };
  constexpr double step_m = 10.0;
  SettingRange range{};
  CitySettings::describe(settings, [&range](std::string_view name, auto, SettingRange r, auto&&...) {
    if (name == "size") range = r;
  });
  const auto wanted = static_cast<double>(buildings);
  if (buildings < 1 || wanted > count_at(range.high))
    throw InvalidArgument(
        fmt::format("--buildings is {}; a city can have from 1 to about {:.3g}", buildings, count_at(range.high)));
  // Halve the interval of sizes that brackets the wanted number
  double low_m = range.low, high_m = range.high;
  while (high_m - low_m > step_m) {
    const double middle_m = step_m * std::round(0.5 * (low_m + high_m) / step_m);
    if (middle_m <= low_m || middle_m >= high_m) break;
    (count_at(middle_m) < wanted ? low_m : high_m) = middle_m;
  }
  return std::abs(count_at(low_m) - wanted) < std::abs(count_at(high_m) - wanted) ? low_m : high_m;
}

}  // namespace farlod
