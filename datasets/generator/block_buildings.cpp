// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/block_buildings.hpp"

#include <fmt/format.h>

#include <utility>

#include "generator/building_solid.hpp"
#include "generator/open_shells.hpp"

namespace farlod {
namespace {

/// Raises the buildings of one block.
class BlockRaiser {
 public:
  BlockRaiser(const CitySettings& settings, CityBlock block)
      : settings_(settings), block_(block), field_(settings), plans_(plans_of_block(settings, block)) {}

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
    building.solids.push_back(raise(plan, ground_m, settings_.lod));
    return building;
  }

  const CitySettings& settings_;
  CityBlock block_;
  UrbanField field_;
  std::vector<BuildingPlan> plans_;
};

}  // namespace

std::vector<PlanBuilding> raise_block(const CitySettings& settings, CityBlock block) {
  return BlockRaiser(settings, block).buildings();
}

}  // namespace farlod
