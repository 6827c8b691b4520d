// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/box.hpp"
#include "farlod/problem.hpp"
#include "plausibility/standing_heights.hpp"

namespace farlod::plausibility {

/// The ground of a raster where buildings stand.
struct GroundBelowBuildings {
  std::vector<double> height_m;                            ///< in the middle of each building
  std::vector<double> slope;                               ///< across each of them, rise over horizontal distance
  std::vector<std::pair<double, double>> base_and_ground;  ///< of those whose bases are elevations, in metres
  Box2d outline;                                           ///< of the buildings
  Point3d highest;
};

[[nodiscard]] GroundBelowBuildings ground_below(const LocatedCity& located, const SurveyedGround& ground);

/// implausible_size where the ground rises with the bases of buildings, but by another unit: of eight buildings and more, all but
/// the lowest and highest twentieth, it varies about 100 times as much as the bases (centimetres), 1000 times (millimetres) or
/// 3.28 times (feet), and with them. Returns whether it is told. Throws InputError where most bases are 10 m and more from it.
bool report_unit_of_terrain(const GroundBelowBuildings& below, const LocatedCity& located, const SurveyedGround& ground,
                            Report& report);

/// implausible_size where the ground is too steep for a town: half of eight buildings and more stand on a slope of more than 1,
/// and it ranges over more than 100 m. Returns whether it is told.
bool report_steep_terrain(const GroundBelowBuildings& below, const LocatedCity& located, const SurveyedGround& ground,
                          Report& report);

}  // namespace farlod::plausibility
