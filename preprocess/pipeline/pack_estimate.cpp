// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "base/machine_memory.hpp"
#include "base/paging/memory_bound.hpp"
#include "base/paging/pages.hpp"
#include "farlod/error.hpp"

namespace farlod::pipeline {
namespace {

// Measured with `farlod-pack --summary` on generated cities of 35,000 to 10 million polygons (`farlod-city --towers 0.3`) with
// cells of 35 to 100 m, and on Queens, Omiya and Manhattan; see docs/performance.md. Rounded, mostly upwards.

/// Triangles in the tiles for each triangle of the buildings. The ground adds two thirds of their number. Borders of cells cut
/// triangles, and the more of them the smaller the cells are.
constexpr double tiles_per_city_triangle = 1.7, cut_by_borders_m = 55.0;
/// n points of the ground make 2n triangles; few of them cross borders.
constexpr double tiles_per_ground_point = 2.2;

/// The program itself with its libraries, and batches that are cut.
constexpr double memory_mib_of_program = 50.0, memory_mib_of_batches = 40.0;
/// The long arrays of the city, by its points and its facets. Those on disk take memory as MemoryBound lets them.
constexpr std::array bytes_per_point{24.0};
constexpr std::array bytes_per_facet{24.0, 8.0, 72.0};
/// Those of the tiles, by their triangles: polygons and edges as noted down, and vertices, triangles, surfaces, edges and
/// occluders.
constexpr std::array bytes_per_tile_triangle{48.0, 7.0, 36.0, 12.0, 4.0, 6.0, 11.0};
/// The network of the ground and the points that it is made of, for each of its points.
constexpr std::array bytes_per_ground_point{130.0, 24.0};
/// The surface of a surface model, for each of its triangles, with the edges beside them.
constexpr std::array bytes_per_surface_triangle{72.0, 60.0};
/// In memory: a building and its name; a tile and its counts; a point of a survey; and for far maps of the kind `box` an index of
/// rays over the triangles, and the vertices that it is made of.
constexpr double bytes_per_building = 150.0, bytes_per_cell = 500.0, bytes_per_surveyed_point = 40.0;
/// A pixel of a surface model: its height, and what it is joined with.
constexpr double bytes_per_pixel = 12.0;
constexpr double ray_index_bytes_per_triangle = 150.0;
/// Where neither a terrain nor a relief is given, the ground passes through so many of the city's points.
constexpr double base_points_per_point = 0.16;
/// A block: a baked far map, and of a triangle in the tiles what is written, while it is gathered and put in order.
constexpr double bytes_per_baked_map = 48.0 * 1024.0, written_bytes_per_triangle = 60.0;

/// Share of what lies on disk that is in use at a time, or not let go yet: about so much.
constexpr double in_use_of_files = 0.3;

/// Beside each other: the trees, or the pixels of a canopy, and their crowns.
constexpr std::array bytes_per_tree{static_cast<double>(sizeof(Tree))};
constexpr std::array bytes_per_crown{static_cast<double>(sizeof(CrownsOfCity::OwnedCrown))};
constexpr std::array bytes_per_canopy_pixel{static_cast<double>(sizeof(float))};

constexpr double package_bytes_per_triangle = 28.0, package_bytes_per_pixel = 5.0;
constexpr double package_bytes_per_horizon_map = 10000.0, package_bytes_per_box_map = 6000.0;

/// On one core: cutting and writing a triangle.
constexpr double seconds_per_triangle = 4e-6;
/// Placing a crown, sorting it and writing it, on one core however many there are.
constexpr double seconds_per_crown = 1e-6;

constexpr double bytes_per_mib = 1048576.0;

/// In the tiles, of buildings. A polygon of n corners has n − 2 triangles.
double tile_triangles(std::size_t points, std::size_t facets, const Grid& grid) {
  return (static_cast<double>(points) - 2.0 * static_cast<double>(facets)) *
         (tiles_per_city_triangle + cut_by_borders_m / grid.cell_edge_m);
}

double triangles_of(const GroundLoad& ground) {
  return ground.is_surface ? ground.triangles : tiles_per_ground_point * static_cast<double>(ground.points);
}

double triangles_in_tiles(const CityModel& city, const GroundLoad& ground, const Grid& grid) {
  return tile_triangles(city.points().size(), city.facets().size(), grid) + triangles_of(ground);
}

/// The triangles in the tiles of the block that has the most of them.
double triangles_in_densest_block(const CityModel& city, const GroundLoad& ground, const Grid& grid) {
  std::map<Block, double> of_buildings;
  city.for_each_building([&](std::size_t, const Building& b) {
    const std::span<const Point3d> points = city.points_of(b);
    if (points.empty()) return;
    const Cell cell = grid.cell_of(grid.rotation.grid_from_city(horizontal(points.front())));
    of_buildings[grid.block_of(cell)] += tile_triangles(points.size(), b.facet_count, grid);
  });
  double most = 0.0;
  for (const auto& [block, triangles] : of_buildings) most = std::max(most, triangles);
  return most + triangles_of(ground) / static_cast<double>(grid.blocks().size());
}

/// Bytes of arrays: long ones lie on disk.
struct Arrays {
  double in_memory = 0.0, on_disk = 0.0;

  void add(std::span<const double> bytes_per_element, double elements) {
    for (const double bytes : bytes_per_element)
      (bytes * elements < static_cast<double>(Pages::least_on_disk) ? in_memory : on_disk) += bytes * elements;
  }
};

}  // namespace

CanopyLoad canopy_load_of(const tiles::TreesOfCity& trees) {
  CanopyLoad load;
  load.trees = trees.trees.size();
  if (!trees.canopy) return load;
  load.pixels = trees.canopy->top_m.size();
  load.has_trunks = !trees.canopy->trunk_m.empty();
  for (const float top_m : trees.canopy->top_m) load.cells += std::isfinite(top_m) && top_m != 0.0F ? 1 : 0;
  return load;
}

PackMemory memory_of_pack(const CityModel& city, const GroundLoad& ground, const Grid& grid, FarMapKind far_map,
                          const CanopyLoad& canopy) {
  const auto points = static_cast<double>(city.points().size()), surveyed = static_cast<double>(ground.points);
  const double triangles = triangles_in_tiles(city, ground, grid);
  Arrays arrays;
  arrays.add(bytes_per_point, points);
  arrays.add(bytes_per_facet, static_cast<double>(city.facets().size()));
  arrays.add(bytes_per_tile_triangle, triangles);
  if (!ground.is_surface) arrays.add(bytes_per_ground_point, ground.points > 0 ? surveyed : base_points_per_point * points);
  if (ground.is_surface) arrays.add(bytes_per_surface_triangle, ground.triangles);
  arrays.add(bytes_per_tree, static_cast<double>(canopy.trees));
  arrays.add(bytes_per_crown, static_cast<double>(canopy.crowns()));
  arrays.add(bytes_per_canopy_pixel, static_cast<double>(canopy.pixels));
  if (canopy.has_trunks) arrays.add(bytes_per_canopy_pixel, static_cast<double>(canopy.pixels));
  const double index = bytes_per_building * static_cast<double>(city.buildings().size()) +
                       bytes_per_cell * static_cast<double>(grid.cells.size()) +
                       (ground.is_surface ? bytes_per_pixel : bytes_per_surveyed_point) * surveyed +
                       (far_map == FarMapKind::box ? ray_index_bytes_per_triangle * triangles : 0.0);
  const double cells_of_block =
      std::min(static_cast<double>(grid.block_edge) * grid.block_edge, static_cast<double>(grid.cells.size()));
  const double block =
      bytes_per_baked_map * cells_of_block + written_bytes_per_triangle * triangles_in_densest_block(city, ground, grid);
  return {memory_mib_of_program + (index + arrays.in_memory) / bytes_per_mib, block / bytes_per_mib,
          arrays.on_disk / bytes_per_mib};
}

double PackMemory::in_memory_mib(std::size_t blocks) const {
  return always_mib + std::max(memory_mib_of_batches, static_cast<double>(blocks) * block_mib);
}

double PackMemory::least_mib() const {
  return in_memory_mib(1) + static_cast<double>(MemoryBound::least_of_files) / bytes_per_mib;
}

std::size_t PackMemory::blocks_at_once(std::size_t wanted, const RunSettings& run) const {
  if (!run.memory_limit_mib) return wanted;
  const double left_mib = static_cast<double>(*run.memory_limit_mib) - least_mib();
  const double more = std::max(0.0, std::floor(left_mib / std::max(block_mib, 1.0)));
  return more >= static_cast<double>(wanted) ? wanted : std::min(wanted, 1 + static_cast<std::size_t>(more));
}

PackEstimate estimate_pack(const PackMemory& memory, const CityModel& city, const GroundLoad& ground, const Grid& grid,
                           FarMapKind far_map, const CanopyLoad& canopy, std::size_t threads,
                           std::optional<std::uint64_t> far_maps) {
  const bool is_box = far_map == FarMapKind::box;
  const double triangles = triangles_in_tiles(city, ground, grid);
  PackEstimate e;
  e.cells = static_cast<std::uint64_t>(grid.cells.size());
  e.far_maps = far_maps.value_or(e.cells);
  const auto maps = static_cast<double>(e.far_maps);
  const auto crowns = static_cast<double>(canopy.crowns());
  e.seconds =
      (triangles * seconds_per_triangle + maps * seconds_per_far_map) / static_cast<double>(std::max<std::size_t>(threads, 1)) +
      crowns * seconds_per_crown;
  const double per_map = is_box ? package_bytes_per_box_map : package_bytes_per_horizon_map;
  const double of_pixels = ground.is_surface ? package_bytes_per_pixel * static_cast<double>(ground.points) : 0.0;
  e.package_mib = (triangles * package_bytes_per_triangle + of_pixels + maps * per_map + crowns * sizeof(Crown)) / bytes_per_mib;
  e.memory_mib = memory.in_memory_mib(usual_blocks_at_once) +
                 std::min(in_use_of_files * memory.on_disk_mib, static_cast<double>(MemoryBound::most_of_files) / bytes_per_mib);
  e.least_memory_mib = memory.least_mib();
  return e;
}

namespace {

/// Within a limit, the same is packed with less memory, and slower.
void require_less_than_machine(const PackEstimate& estimate, double least_mib) {
  constexpr double share_of_machine = 0.8;
  const std::optional<double> machine_bytes = machine_memory_bytes();
  if (!machine_bytes || !is_beyond_machine(estimate.memory_mib * bytes_per_mib)) return;
  const double machine_mib = *machine_bytes / bytes_per_mib;
  throw LimitReached("Packing into " + std::to_string(estimate.cells) + " cells takes about " +
                     std::to_string(std::llround(estimate.memory_mib)) + " MiB, and this machine has " +
                     std::to_string(std::llround(machine_mib)) + " MiB: --memory-limit " +
                     std::to_string(std::llround(std::max(least_mib, share_of_machine * machine_mib))) +
                     " packs the same within that, or pack fewer inputs at a time.");
}

}  // namespace

void require_memory(const PackEstimate& estimate, const RunSettings& run) {
  const double least_mib = std::ceil(estimate.least_memory_mib + static_cast<double>(run.caller_bytes) / bytes_per_mib);
  if (!run.memory_limit_mib) require_less_than_machine(estimate, least_mib);
  if (!run.memory_limit_mib || least_mib <= static_cast<double>(*run.memory_limit_mib)) return;
  throw LimitReached("Packing into " + std::to_string(estimate.cells) + " cells needs at least " +
                     std::to_string(std::llround(least_mib)) + " MiB, more than --memory-limit " +
                     std::to_string(*run.memory_limit_mib) + ": raise the limit to that, or pack fewer inputs at a time.");
}

}  // namespace farlod::pipeline
