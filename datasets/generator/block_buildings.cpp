// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/block_buildings.hpp"

#include <fmt/format.h>

#include <utility>

#include "generator/building_solid.hpp"
#include "generator/open_shells.hpp"
#include "generator/touching_walls.hpp"

namespace farlod {
namespace {

/// The widest eaves of the steepest roof hang down by 1.25 m, and stay above the ground.
constexpr double lowest_wall_with_eaves_m = 2.0;

/// Roofs do not project over a neighbour that touches the wall.
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

  [[nodiscard]] PlanBuilding building(std::size_t row) const {
    const BuildingPlan& plan = plans_[row];
    PlanBuilding building = named("building", row, plan);
    const double ground_m = base_m(field_, plan);
    if (plan.parts.empty())
      building.solids.push_back(raise(plan, ground_m, settings_.lod, overhangs_of(settings_, walls_, row, plan)));
    for (const BuildingPlan& part : plan.parts) {
      building.solids.push_back(raise(part, ground_m, settings_.lod, overhangs_of(settings_, walls_, row, part)));
      building.solids.back().kind = ComponentKind::part;
      building.solids.back().suffix = fmt::format("_part_{}", building.solids.size());
    }
    return building;
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
