// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "generator/generated_building.hpp"

namespace farlod {

/// Raises a plan to a closed solid on `ground_m`. With `lod` 1 it is a prism with a flat top at half the height of its roof.
[[nodiscard]] GeneratedBuilding raise(const BuildingPlan& plan, double ground_m, const PlanRotation& rotation, int lod);

}  // namespace farlod
