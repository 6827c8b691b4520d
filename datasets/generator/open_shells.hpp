// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/plan_solid.hpp"

namespace farlod {

/// Makes the buildings of a block open shells, like models from airborne scans: without floors, and without those parts of walls
/// that coincide with a facing wall of another building. The rest of such a wall is cut into convex facets. Walls with openings,
/// soffits and installations are not changed.
void open_shells(std::vector<PlanBuilding>& buildings);

}  // namespace farlod
