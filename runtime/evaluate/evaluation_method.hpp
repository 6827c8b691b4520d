// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "base/grid.hpp"
#include "farlod/evaluation.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// The far map of a cell.
enum class FarMapOfCell {
  horizon,
  box,
  missing,         ///< the cell is one of the grid, and far maps were made for others
  outside_of_grid  ///< there are no cells, and no far maps
};

[[nodiscard]] FarMapOfCell far_map_of(const PackageReader& package, Cell cell);

/// How the receivers of a cell are answered. A direction is free when
enum class EvaluationMethod {
  horizons_and_rays,      ///< it lies above the horizon, or a ray through the gap below an overhang meets nothing
  horizons_alone,         ///< it lies above the horizon; throws PackageUnusable where rays are needed
  rays_against_horizons,  ///< the same as horizons_and_rays, asked for each of --rays directions instead of each azimuth
  near_scene_and_box,     ///< its ray meets no near tile, and the box far map has no occluder in this direction
  near_scene_alone,       ///< its ray meets no near tile
  whole_city              ///< its ray meets no tile of the package
};
inline constexpr std::size_t evaluation_method_count = 6;

/// The only place that decides which method answers a cell:
///
///   engine      far map `horizon`       far map `box`        missing            outside of the grid
///   automatic   horizons_and_rays       near_scene_and_box   whole_city         whole_city
///   horizon     horizons_alone          near_scene_and_box   horizons_alone     whole_city
///   rays        rays_against_horizons   near_scene_and_box   whole_city         whole_city
///   exact       whole_city              whole_city           whole_city         whole_city
///   near_only   near_scene_alone        near_scene_alone     near_scene_alone   whole_city
[[nodiscard]] EvaluationMethod method_of(Engine engine, FarMapOfCell far_map);

}  // namespace farlod
