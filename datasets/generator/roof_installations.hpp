// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "generator/building_plan.hpp"
#include "generator/keyed_random.hpp"
#include "generator/plan_solid.hpp"

namespace farlod {

/// Draws chimneys and gabled dormers for a house with a gabled rectangle as roof. They are installations: closed solids that
/// begin inside the roof and come out through it.
void maybe_add_roof_installations(KeyedRandom& random, const BuildingPlan& plan, PlanBuilding& building);

}  // namespace farlod
