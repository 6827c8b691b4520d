// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/building_plan.hpp"

namespace farlod {

/// With `overlapping_parts`: makes some of a block's buildings of parts, which stay in the building's rectangle. A tower or an
/// office becomes a podium and a tower that stands on the ground inside it, sometimes with a lift tower inside both. A house or
/// a hall becomes a shorter house and a lower annex that reaches into it, sometimes with a stair tower inside both.
void divide_into_parts(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans);

/// With `projecting_floors`: lets the ground floors of some buildings without parts stand back by 0.5 to 2 m: on all sides where
/// no other building touches, else on the street's side. Their roofs become flat.
void let_floors_project(const CitySettings& settings, CityBlock block, std::vector<BuildingPlan>& plans);

}  // namespace farlod
