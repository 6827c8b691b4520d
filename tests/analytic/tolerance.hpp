// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "package/far_map.hpp"

namespace farlod {

/// Error of a sky view factor that is the share of free cells among k equal ones, when the border between sky and city, drawn on
/// the unit disk (or the unit hemisphere), has a length of at most `border_length`.
///
/// Only cells that the border crosses can be wrong. Cells have the area π/k (2π/k) and are nearly square: within the factor 1.6
/// their diameter is d = 1.6·√(2·area). All that the border crosses lies within d of it, in an area of 2dL + πd²: at most
/// n = (2dL + πd²)/area cells. One sample in each is right or wrong with a variance of at most 1/4, so the share has
/// a standard deviation of at most √n/(2k); five of them bound it but for one case in two million.
[[nodiscard]] inline double sampling_error(std::size_t k, double border_length) {
  const double cells = static_cast<double>(k);
  const double area = 2.0 * std::numbers::pi / cells;  // the larger of the two, which crosses fewer but larger cells
  const double d = 1.6 * std::sqrt(2.0 * area);
  const double crossed = (2.0 * d * border_length + std::numbers::pi * d * d) / (area / 2.0);
  return 5.0 * std::sqrt(crossed) / (2.0 * cells);
}

/// Largest derivative of sin²β by t = tan β: 2t/(1 + t²)², at t = 1/√3. That of sin β, 1/(1 + t²)^(3/2), is at most 1.
inline constexpr double steepest_cos = 0.6495190528383290;
inline constexpr double steepest_solid = 1.0;

/// Error of a sky view factor that is looked up in a box map from its capture point. `rise` bounds the total variation of the
/// horizon's tangent along the circle (up and down).
///
/// A texel is blocked when its middle is: the horizon that the map holds is off by at most half a row, top/(2·rows), and is taken
/// at an azimuth that is off by at most half a column, 1/side_columns (the columns are widest at the middle of a side). The first
/// shifts tan β by at most half a row everywhere; the second, integrated over the circle, by at most rise/side_columns.
[[nodiscard]] inline double box_map_error(const BoxMap& map, double rise, double steepest) {
  const double rows = static_cast<double>(map.top) / (2.0 * map.rows);
  const double columns = rise / map.side_columns / (2.0 * std::numbers::pi);
  return steepest * (rows + columns);
}

}  // namespace farlod
