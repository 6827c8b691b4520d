// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/building_plan.hpp"

namespace farlod {

/// With `overlapping_parts`: divides some buildings of a block into parts inside of the rectangle of the building. A tower or an
/// office becomes a podium and a tower that goes through it to the ground, sometimes with a lift tower inside of both. A house or
/// a hall becomes a shorter house and a lower annex that overlaps it, sometimes with a stair tower inside of both.
void divide_into_parts(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans);

/// With `projecting_floors`: the upper floors of some buildings without parts project by 0.5 to 2 m, on all sides if no other
/// building touches them, else on the side of the street. Their roofs become flat.
void let_floors_project(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans);

}  // namespace farlod
