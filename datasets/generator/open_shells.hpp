// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/plan_solid.hpp"

namespace farlod {

/// Makes the buildings of a block open shells, as models from airborne scans have them: without floors, and without what a wall
/// shares with a wall of another building that looks against it. What is left of a wall is cut into convex facets. Walls with
/// openings, soffits and installations stay as they are.
void open_shells(std::vector<PlanBuilding>& buildings);

}  // namespace farlod
