// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod::plausibility {

/// The heights of a city without buildings of its own: a surface model, a terrain, a relief.
struct SurfaceShape {
  std::size_t points = 0;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  std::optional<Point3d> highest;  ///< the first of the highest points
  std::set<double> whole_numbers;  ///< of the heights, as long as they are few and all are whole
  bool are_whole = true;
  /// How far the surface climbs and falls on ways over it, and how long these ways are in the plan.
  double rise_m = 0.0, run_m = 0.0;

  void add(const Point3d& p);
};

/// Ways go along each row and along columns, by steps of 2 m and more: noise of small pixels is no relief.
[[nodiscard]] SurfaceShape shape_of(const TerrainRaster& surface);
/// Points of rows, triangles or lines: most have a neighbour before them.
[[nodiscard]] SurfaceShape shape_of(std::span<const Point3d> points);

/// Why these are hardly the heights of a city in metres, in words that go on behind the name of the file, with what to do; none
/// where they may be, or where there are fewer than a hundred.
///   (1) flat: they differ, but by a metre at the most, as sky view factors and other shares do
///   (2) classes: whole numbers from 0 to 8, at least four different ones
///   (3) steep: on the average the surface climbs or falls by 4 m on a metre, as centimetres taken for metres do. Walls of
///       dense towns, trees and mountains together make less than 2
[[nodiscard]] std::optional<std::string> doubt_about_surface(const SurfaceShape& shape);

}  // namespace farlod::plausibility
