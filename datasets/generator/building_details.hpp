// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/generated_building.hpp"
#include "generator/keyed_random.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {

/// Cuts windows, one for each storey and bay, and a front door into the walls of a solid that no other building touches. A facet
/// fills each opening: flush with the wall or, for half of the buildings, set back with a reveal around it. A closed solid stays
/// closed. `row` is the number of the building in the block.
void add_openings(KeyedRandom& random, const BuildingPlan& plan, const TouchingWalls& walls, std::size_t row, PlanSolid& solid);

/// Makes the buildings of a block open shells, like models from airborne scans: without floors, and without those parts of walls
/// that coincide with a facing wall of another building. The rest of such a wall is cut into convex facets. Walls with openings,
/// soffits and installations are not changed.
void open_shells(std::vector<PlanBuilding>& buildings);

/// Adds chimneys and gabled dormers at random to a rectangular house with a gabled roof. They are installations: closed solids
/// that begin inside of the roof and extend beyond it.
void maybe_add_roof_installations(KeyedRandom& random, const BuildingPlan& plan, PlanBuilding& building);

}  // namespace farlod
