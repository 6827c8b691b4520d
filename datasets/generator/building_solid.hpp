// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "generator/pitched_roof.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {

/// Raises a plan to a solid on `ground_m`. With `lod` 1 it is a prism with a flat top at half the height of its roof. The solid
/// is closed, unless its roof overhangs.
[[nodiscard]] PlanSolid raise(const BuildingPlan& plan, double ground_m, int lod, const Overhangs& overhangs = {});

}  // namespace farlod
