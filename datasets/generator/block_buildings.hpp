// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/city_layout.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {

/// The buildings of a block as solids with the features of the settings, followed by the bridges that start from the block.
[[nodiscard]] std::vector<PlanBuilding> raise_block(const CitySettings& settings, CityBlock block);

}  // namespace farlod
