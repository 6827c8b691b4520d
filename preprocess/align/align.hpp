// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"

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

struct GridSettings {
  double cell_edge_m = 150.0;
  int neighborhood = 3;  ///< odd
  int block_edge = 32;
  AlignMode align = AlignMode::automatic;
  Angle fixed_bearing = {};  ///< clockwise from grid north
};

/// Below this strength a city has no dominant direction. Of a city whose walls else point evenly everywhere, the strength
/// is the share that follows the grid: with less than a tenth, nothing is gained by turning. Chance alone gives
/// 0.9/√n with n walls, so that a hundred walls without order stay below.
inline constexpr double least_alignment_strength = 0.1;

struct GridAlignment {
  Grid grid;
  Alignment streets;  ///< as found, whether or not the grid follows them
};

/// Lays the grid over a city.
///   (1) its y axis runs along the bearing that the settings ask for
///   (2) every point of the city is in a cell, those on the outer borders included
///   (3) a city without a dominant direction is reported, and gets the bearing 0
///   (4) a grid that is very large for its buildings is reported
/// Throws InputError when the buildings lie so far apart that the grid would have too many cells.
[[nodiscard]] GridAlignment align(const LocatedCity& located, const GridSettings& settings, Report& report);

/// Lays the grid over a rectangle of the city frame, for a terrain without buildings: to grid north, or along the fixed
/// bearing. Same promises.
[[nodiscard]] Grid grid_over(const Box2d& box_city, const GridSettings& settings);

}  // namespace farlod::align
