// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "city/pages.hpp"

namespace farlod::pipeline {
namespace {

// Measured with `farlod-pack --summary` on generated cities of 35,000 to 10 million polygons (`farlod-city --towers 0.3`) with
// cells of 35 to 100 m, and on Queens, Omiya and Manhattan; see docs/performance.md. Rounded, mostly upwards.

/// Triangles in the tiles for each triangle of the buildings. The ground adds two thirds of their number. Borders of cells cut
/// triangles, and the more of them the smaller the cells are.
constexpr double tiles_per_city_triangle = 1.7, cut_by_borders_m = 55.0;
/// n points of the ground make 2n triangles; few of them cross borders.
constexpr double tiles_per_ground_point = 2.2;

/// The program itself; two blocks of far maps, one of them being written.
constexpr double memory_mib_of_program = 45.0, memory_mib_of_blocks = 60.0;
constexpr double cells_of_a_block = 1024.0;
/// Of a long array, which lies on disk, about so much is in memory.
constexpr double memory_bytes_of_array_on_disk = 8.0 * 1048576.0;
/// The long arrays of the city, by its points and its facets.
constexpr std::array bytes_per_point{24.0};
constexpr std::array bytes_per_facet{24.0, 8.0, 72.0};
/// Those of the tiles, by their triangles: polygons and edges as noted down, and vertices, triangles, surfaces and edges.
constexpr std::array bytes_per_tile_triangle{48.0, 7.0, 36.0, 12.0, 4.0, 6.0};
/// In memory: a building and its name; a tile, its counts and its node in the tree of the city; the network of the ground, for
/// each of its points; occluders, for each triangle in the tiles; an index of rays over the triangles, and the vertices that it
/// is made of.
constexpr double bytes_per_building = 150.0, bytes_per_cell = 500.0, network_bytes_per_point = 200.0;
constexpr double occluder_bytes_per_triangle = 11.0, ray_index_bytes_per_triangle = 150.0;
/// Where neither a terrain nor a relief is given, the ground passes through so many of the city's points.
constexpr double base_points_per_point = 0.16;

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

double memory_of_arrays(std::span<const double> bytes_per_element, double elements) {
  double sum = 0.0;
  for (const double bytes : bytes_per_element) {
    const double all = bytes * elements;
    sum += all < static_cast<double>(Pages::least_on_disk) ? all : memory_bytes_of_array_on_disk;
  }
  return sum;
}

double memory_mib(const CityModel& city, std::size_t ground_points, const Grid& grid, double triangles, double maps,
                  bool is_box) {
  const auto points = static_cast<double>(city.points().size()), cells = static_cast<double>(grid.cells.size());
  const double arrays = memory_of_arrays(bytes_per_point, points) +
                        memory_of_arrays(bytes_per_facet, static_cast<double>(city.facets().size())) +
                        memory_of_arrays(bytes_per_tile_triangle, triangles);
  const double always = bytes_per_building * static_cast<double>(city.buildings().size()) + bytes_per_cell * cells;
  // The network of the ground ends with the tiles, before the far maps
  const double network =
      network_bytes_per_point * (ground_points > 0 ? static_cast<double>(ground_points) : base_points_per_point * points);
  const double far_maps = triangles * (is_box ? ray_index_bytes_per_triangle : occluder_bytes_per_triangle) +
                          memory_mib_of_blocks * bytes_per_mib * std::min(1.0, maps / cells_of_a_block);
  return memory_mib_of_program + (arrays + always + std::max(network, far_maps)) / bytes_per_mib;
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
  e.memory_mib = memory_mib(city, ground_points, grid, triangles, maps, is_box);
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
