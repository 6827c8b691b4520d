// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "georeference/raster_reader.hpp"
#include "package/far_terrain.hpp"
#include "tiles/ground.hpp"

namespace farlod::far_terrain {

/// How much of a terrain beyond the grid is kept.
struct FarTerrainSettings {
  /// Heights are kept to within this share of their distance from the grid: a sine of the elevation, about.
  double tolerance = 0.002;
  double nearest_m = 250.0;              ///< what is nearer counts as this far away
  double farthest_m = 200e3;             ///< beyond it, nothing is read: a mountain of 3,000 m is below the horizon
  std::size_t most_triangles = 400'000;  ///< with more, the tolerance is doubled
};

/// What making one with the most triangles takes, edges included, besides what GDAL keeps of the file.
inline constexpr double most_mib = 160.0;

/// What is known of the ground around a city before its far terrain is made.
struct CityGround {
  const Georeference& georeference;
  const Grid& grid;
  double height_origin_m = 0.0;
  double lowest_m = 0.0;  ///< of the ground: what lies below it hides nothing
  tiles::GroundHeightAt ground_m;
};

/// By how much the Earth's curvature makes a place seem lower, less what refraction lifts it (k = 0.13, as surveyors take it).
[[nodiscard]] double sinking_m(double distance_m);

/// A raster of heights, and what is added to them.
struct FarTerrainSource {
  georeference::TerrainFile file;
  double offset_m = 0.0;
  bool is_ground = false;  ///< the ground of the city is a part of it
};

/// The far terrain of rasters beyond the grid.
///   (1) each pixel beyond the grid and within `farthest_m` is within the tolerance of the far terrain, but where pixels are seen
///   under
///       less than the tolerance: of those, some are left out
///   (2) where rasters overlap, the first counts that has a height
///   (3) what is hidden from all places of the city by the level of its lowest ground is left out
///   (4) places sink by `sinking_m` of their distance from the middle of the grid: in full from 5 km beyond the grid on, before
///   that
///       by a share that grows with the distance, so that the ground has no step at the border
///   (5) a raster that is not the ground of the city, and stands above or below it along the border of the grid (border_step), is
///       reported as of another datum, and one with an undeclared number for no data as such
/// Throws InputError when a file cannot be read, when it is nowhere near, or when (5) is so all around; Cancelled. `notes` are
/// for the user.
[[nodiscard]] FarTerrain far_terrain_around(std::span<const FarTerrainSource> sources, const std::string& fallback_crs,
                                            const CityGround& city, const FarTerrainSettings& settings, Report& report,
                                            std::vector<std::string>& notes, const std::stop_token& stop = {});

}  // namespace farlod::far_terrain
