// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/block_buildings.hpp"

#include <fmt/format.h>

#include <utility>

#include "generator/balconies.hpp"
#include "generator/building_solid.hpp"
#include "generator/facade_openings.hpp"
#include "generator/keyed_random.hpp"
#include "generator/open_shells.hpp"
#include "generator/roof_installations.hpp"
#include "generator/touching_walls.hpp"

namespace farlod {
namespace {

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

}  // namespace

std::vector<PlanBuilding> raise_block(const CitySettings& settings, CityBlock block) {
  return BlockRaiser(settings, block).buildings();
}

}  // namespace farlod
