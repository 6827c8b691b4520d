// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "plausibility/standing_heights.hpp"

namespace farlod::plausibility {

/// Throws InputError when a raster of the ground has roofs in it: of at least eight buildings, three quarters stand on a bump of
/// their own size, 2.5 m and higher than the ground on both sides of it.
void require_ground_without_roofs(const LocatedCity& located, const SurveyedGround& ground);

/// Compares roofs whose elevations are known, but not how far down the buildings reach, with the ground. Of at least eight
/// buildings of a file:
///   (1) throws InputError when half of the roofs are below the ground
///   (2) another_datum when a tenth of them are; or when 19 of 20 are 30 m and more above it: a town has low houses, too
void report_roofs(const LocatedCity& located, const SurveyedGround& ground, Report& report);

}  // namespace farlod::plausibility
