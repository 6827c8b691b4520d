// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace farlod::pipeline {
namespace {

// Measured with `farlod-pack --summary` on generated cities of 35,000 to 10 million polygons (`farlod-city --towers 0.3`) with
// cells of 35 to 100 m, and on Queens, Omiya and Manhattan; see docs/performance.md. Rounded, mostly upwards.

/// Triangles in the tiles for each triangle of the buildings. The ground adds two thirds of their number. Borders of cells cut
/// triangles, and the more of them the smaller the cells are.
constexpr double tiles_per_city_triangle = 1.7, cut_by_borders_m = 55.0;
/// n points of the ground make 2n triangles; few of them cross borders.
constexpr double tiles_per_ground_point = 2.2;

/// Tiles, surfaces, horizon edges, and the city model while it is cut; and an index of rays over the triangles.
constexpr double memory_bytes_per_triangle = 160.0, ray_index_bytes_per_triangle = 100.0;
/// The program itself; two blocks of far maps, one of them being written.
constexpr double memory_mib_of_program = 50.0, memory_mib_of_blocks = 60.0;
constexpr double cells_of_a_block = 1024.0;

constexpr double package_bytes_per_triangle = 28.0;
constexpr double package_bytes_per_horizon_map = 10000.0, package_bytes_per_box_map = 6000.0;

/// On one core: cutting and writing a triangle; baking and writing a far map of either kind.
constexpr double seconds_per_triangle = 4e-6, seconds_per_far_map = 4e-3;

constexpr double bytes_per_mib = 1048576.0;

double triangles_in_tiles(const CityModel& city, std::size_t ground_points, const Grid& grid) {
  // A polygon of n corners has n − 2 triangles
  const double of_city = static_cast<double>(city.points().size()) - 2.0 * static_cast<double>(city.facets().size());
  const double of_terrain = tiles_per_ground_point * static_cast<double>(ground_points);
  return of_city * (tiles_per_city_triangle + cut_by_borders_m / grid.cell_edge_m) + of_terrain;
}

}  // namespace

PackEstimate estimate_pack(const CityModel& city, std::size_t ground_points, const Grid& grid, FarMapKind far_map,
                           std::size_t threads, std::optional<std::uint64_t> far_maps) {
  const bool is_box = far_map == FarMapKind::box;
  const double triangles = triangles_in_tiles(city, ground_points, grid);
  PackEstimate e;
  e.cells = static_cast<std::uint64_t>(grid.cells.size());
  e.far_maps = far_maps.value_or(e.cells);
  const auto maps = static_cast<double>(e.far_maps);
  e.seconds =
      (triangles * seconds_per_triangle + maps * seconds_per_far_map) / static_cast<double>(std::max<std::size_t>(threads, 1));
  const double per_triangle = memory_bytes_per_triangle + (is_box ? ray_index_bytes_per_triangle : 0.0);
  e.memory_mib = memory_mib_of_program + memory_mib_of_blocks * std::min(1.0, maps / cells_of_a_block) +
                 triangles * per_triangle / bytes_per_mib;
  const double per_map = is_box ? package_bytes_per_box_map : package_bytes_per_horizon_map;
  e.package_mib = (triangles * package_bytes_per_triangle + maps * per_map) / bytes_per_mib;
  return e;
}

void require_memory(const PackEstimate& estimate, const RunSettings& run) {
  const double needed_mib = estimate.memory_mib + static_cast<double>(run.caller_bytes) / bytes_per_mib;
  if (!run.memory_limit_mib || needed_mib <= static_cast<double>(*run.memory_limit_mib)) return;
  throw LimitReached("Packing into " + std::to_string(estimate.cells) + " cells needs about " +
                     std::to_string(std::llround(needed_mib)) + " MiB, more than --memory-limit " +
                     std::to_string(*run.memory_limit_mib) +
                     ": choose larger cells (--cell), pack fewer inputs at a time, or raise the limit.");
}

}  // namespace farlod::pipeline
