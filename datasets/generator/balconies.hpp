// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "generator/keyed_random.hpp"
#include "generator/plan_solid.hpp"
#include "generator/touching_walls.hpp"

namespace farlod {

/// Decides at random whether a building gets balconies, and adds them to its street front or its rear: closed boxes, one for each
/// storey and bay from the second storey upwards, as installations. Only street fronts, terraces and slabs of flats have them.
/// `row` is the number of the building in the block.
void maybe_add_balconies(KeyedRandom& random, const BuildingPlan& plan, const TouchingWalls& walls, std::size_t row,
                         PlanBuilding& building);

}  // namespace farlod
