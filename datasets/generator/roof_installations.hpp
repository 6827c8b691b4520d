// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "generator/building_plan.hpp"
#include "generator/keyed_random.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {

/// Adds chimneys and gabled dormers at random to a rectangular house with a gabled roof. They are installations: closed solids
/// that begin inside of the roof and extend beyond it.
void maybe_add_roof_installations(KeyedRandom& random, const BuildingPlan& plan, PlanBuilding& building);

}  // namespace farlod
