// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "align/street_alignment.hpp"
#include "base/grid.hpp"
#include "city/located_city.hpp"
#include "farlod/box.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"

namespace farlod::align {

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
