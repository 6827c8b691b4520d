// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "generator/keyed_random.hpp"
#include "generator/plan_solid.hpp"
#include "generator/touching_walls.hpp"

namespace farlod {

/// Cuts windows, one for each storey and bay, and a front door into the walls of a solid that no other building touches. A facet
/// fills each opening: flush with the wall or, for half of the buildings, set back with a reveal around it. A closed solid stays
/// closed. `row` is the number of the building in the block.
void add_openings(KeyedRandom& random, const BuildingPlan& plan, const TouchingWalls& walls, std::size_t row, PlanSolid& solid);

}  // namespace farlod
