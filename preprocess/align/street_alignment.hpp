// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/city_model.hpp"
#include "farlod/angle.hpp"

namespace farlod::align {

/// How the buildings of a city lie along its streets.
struct Alignment {
  Angle bearing;          ///< of the dominant direction, clockwise from grid north, in (-45°, 45°]
  double strength = 0.0;  ///< 0: no direction is preferred; 1: all walls are parallel or perpendicular
};

/// Finds the dominant street direction from the walls, for with W(t) the length of the walls of direction t:
///   bearing: the mean of W, modulo 90°, around the peak of W; so of two grids the stronger, not their average
///   strength: |Σ W e^{4it}| / Σ W over the whole city
/// For any city:
///   (1) how facets are cut into polygons or triangles does not matter, nor how high a building is
///   (2) turning the city by α turns the bearing by α; mirroring it mirrors the bearing; scale and order do not matter
/// All this up to rounding. A city without walls has bearing and strength 0.
/// `city` is in the city frame.
[[nodiscard]] Alignment street_alignment(const CityModel& city);

}  // namespace farlod::align
