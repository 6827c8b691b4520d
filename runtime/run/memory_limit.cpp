// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/memory_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/machine_memory.hpp"
#include "base/run_settings.hpp"
#include "canopy/canopy_field.hpp"
#include "evaluate/verification.hpp"
#include "farlod/error.hpp"
#include "horizon/receiver_packet.hpp"
#include "package/relief_tiles.hpp"
#include "scene/canopy_around.hpp"

namespace farlod {
namespace {

constexpr double mib = 1 << 20;

// Measured on Debian 12, and rounded up
constexpr double program_bytes = 80 * mib;    // the program and its libraries, before there is a cell
constexpr double thread_bytes = 12 * mib;     // scenes of cells, and what the allocator keeps for the next
constexpr double receiver_bytes = 128;        // a receiver on its way, with its answers
constexpr double triangle_bytes = 224;        // of the whole city's scene: the triangle, its corners, Embree's tree
constexpr double exact_triangle_bytes = 100;  // of the TriangleIndex: its corners, and a sixth of a node
constexpr double seen_triangle_bytes = 24;    // of SeenSurfaces: a number, and the sides of a surface

constexpr double crown_bytes = 160;        // of the scene of all crowns, beside the file: the crown, and Embree's tree
constexpr double canopy_bytes = 16 * mib;  // crowns around a cell, those far away merged
constexpr double named_crown_bytes = 100;  // of one in CrownsOfCell, where an error is allowed

// A sample of the sky takes: a direction, and what each thread has at an azimuth, 64 bytes for each of the horizons of an engine
constexpr double direction_bytes = sizeof(Point3d);
constexpr double azimuth_bytes = 100 + (10 + packets_in_group) * 64;  // HorizonEngine
constexpr double bounds_azimuth_bytes = 500 + 17 * 64;                // CertainSky
/// What further quantities add: profiles of a group of packets, and rows that are made of them.
constexpr double profile_azimuth_bytes = (6 * (packets_in_group + 1) + 8) * 64;
// PixelCity: a pixel; at each azimuth, its path near a receiver, and each pixel farther along the sides of the raster
constexpr double pixel_bytes = 5.2, path_bytes = 6000, path_step_bytes = 4;
// CanopyCity: a pixel, and a step of the path at an azimuth
constexpr double canopy_pixel_bytes = 15, canopy_step_bytes = 24;
constexpr double drawn_azimuth_bytes = packets_in_group * 64;  // PixelHorizon
constexpr double ray_azimuth_bytes = 180 + 11 * 64;            // RayEngine, with the directions in the order of their azimuths

bool traces_whole_city(const ResolvedSettings& settings) {
  return settings.sky.engine == Engine::exact || settings.verify > 0 || settings.sky.allowed_error.has_value() ||
         settings.sky.further.horizon_distances || settings.sky.further.any_seen_by_rays();
}

bool uses_crowns(const package::Manifest& manifest, const ResolvedSettings& settings) {
  const Quantities& further = settings.sky.further;
  return manifest.canopy.has_value() &&
         (further.any_of_canopies() || further.any_dimmed_by_crowns() || further.any_seen_by_rays());
}

double bytes_of_canopies(const package::Manifest& manifest, const ResolvedSettings& settings) {
  if (!settings.sky.further.svf_total || !settings.sky.allowed_error) return canopy_bytes;
  return canopy_bytes +
         named_crown_bytes * static_cast<double>(std::min<std::uint64_t>(manifest.canopy->crowns(), most_crowns_by_name));
}

/// The directions as they are and turned to the grid, and those of a normal on each thread.
double bytes_of_directions(std::size_t rays, std::size_t threads) {
  return direction_bytes * static_cast<double>(rays) * (2.0 + static_cast<double>(threads));
}

/// What grows with the numbers of azimuths and rays.
double bytes_of_samples(const package::Manifest& manifest, const ResolvedSettings& settings) {
  const SkySettings& sky = settings.sky;
  const bool has_horizon_maps = !manifest.far_map.is_box(), wants_bounds = settings.bounds || sky.allowed_error;
  const bool by_horizons = has_horizon_maps && (sky.engine == Engine::automatic || sky.engine == Engine::horizon ||
                                                (sky.engine == Engine::rays && wants_bounds));
  const bool by_ray_horizons = has_horizon_maps && sky.engine == Engine::rays;
  const double of_azimuth = azimuth_bytes + (wants_bounds ? bounds_azimuth_bytes : 0.0);
  const double of_profiles = sky.further.any() ? profile_azimuth_bytes * static_cast<double>(sky.azimuths) : 0.0;
  const double of_thread = of_profiles + (by_horizons ? of_azimuth * static_cast<double>(sky.azimuths) : 0.0) +
                           (by_ray_horizons ? ray_azimuth_bytes * static_cast<double>(sky.rays) : 0.0);
  return static_cast<double>(settings.threads) * of_thread + bytes_of_directions(sky.rays, settings.threads);
}

double bytes_of_pixels(const package::Manifest& manifest, const ResolvedSettings& settings) {
  if (!manifest.heights()) return 0.0;
  const double columns = manifest.pixels->columns, rows = manifest.pixels->rows;
  const double of_azimuth =
      path_bytes + path_step_bytes * (columns + rows) + drawn_azimuth_bytes * static_cast<double>(settings.threads);
  const double of_tiles = manifest.pixels->squares ? static_cast<double>(ReliefTiles::most_bytes) : 0.0;
  return pixel_bytes * columns * rows + static_cast<double>(settings.sky.azimuths) * of_azimuth + of_tiles;
}

double crowns_of(const package::Manifest& manifest) { return static_cast<double>(manifest.canopy->crowns()); }

/// CanopyCity: where all crowns are pixels, and lie close to each other.
double bytes_of_canopy_pixels(const package::Manifest& manifest, const ResolvedSettings& settings) {
  const Quantities& further = settings.sky.further;
  const auto is_pixel = static_cast<std::size_t>(CrownShape::prism);
  if (!(further.any_of_canopies() || further.any_dimmed_by_crowns()) || further.canopy.rule != CanopyRule::once) return 0.0;
  if (manifest.canopy->crowns_of_shape[is_pixel] != manifest.canopy->crowns()) return 0.0;
  const double pixels = std::min(CanopyField::most_pixels, CanopyField::most_pixels_per_crown * crowns_of(manifest));
  return canopy_pixel_bytes * pixels + static_cast<double>(settings.sky.azimuths) * canopy_step_bytes * std::sqrt(pixels);
}

/// The scene, and the directions of a verification, which are others.
double bytes_of_whole_city(const package::Manifest& manifest, const ResolvedSettings& settings) {
  const std::size_t rays = settings.verify > 0 ? std::max(verify_rays, settings.sky.rays) : 0;
  const double of_crowns = uses_crowns(manifest, settings) ? (sizeof(Crown) + crown_bytes) * crowns_of(manifest) : 0.0;
  const Quantities& further = settings.sky.further;
  const double of_triangle = triangle_bytes + (settings.bounds || settings.sky.allowed_error ? exact_triangle_bytes : 0.0) +
                             (further.any_of_views() ? seen_triangle_bytes : 0.0);
  return static_cast<double>(manifest.triangles) * of_triangle + bytes_of_directions(rays, settings.threads) + of_crowns;
}

std::string in_mib(double bytes) { return std::to_string(static_cast<std::uint64_t>(std::ceil(bytes / mib))); }

bool is_above_limit(double bytes, const RunSettings& run) {
  return run.memory_limit_mib && bytes > static_cast<double>(*run.memory_limit_mib) * mib;
}

void require_below_limit(double bytes, const RunSettings& run, const std::string& what, const std::string& instead) {
  if (!is_above_limit(bytes, run)) return;
  throw LimitReached(what + " needs about " + in_mib(bytes) + " MiB, more than the limit of " +
                     std::to_string(*run.memory_limit_mib) + " MiB: raise the memory limit, or " + instead + ".");
}

/// What somebody allowed is his to know.
void require_below_machine(double bytes, const RunSettings& run, const std::string& what, const std::string& instead) {
  if (run.memory_limit_mib || !is_beyond_machine(bytes)) return;
  throw LimitReached(what + " needs about " + in_mib(bytes) + " MiB, and this machine has " +
                     in_mib(machine_memory_bytes().value_or(0.0)) + " MiB: " + instead + ", or set a memory limit of " +
                     in_mib(bytes) + " MiB to start all the same.");
}

constexpr const char* take_less = "use fewer threads, a coarser raster, a part at a time, or fewer rays and azimuths";
constexpr const char* without_whole_city =
    "leave out what needs it (the engine exact, a verification, a largest error, distances of horizons, view factors, shadow "
    "patches, points beyond the grid, cells without a far map)";

}  // namespace

std::size_t cells_in_flight(std::size_t threads) { return 4 * threads; }

/// The cells in flight lie side by side along the curve, and their neighborhoods touch four blocks at the most: with fewer, each
/// cell would read them anew; more would only lie there, since the curve leaves a block when all of its cells are done.
std::uint64_t bytes_of_blocks_at_work(const package::Manifest& manifest) {
  constexpr std::uint64_t blocks_at_work = 4;
  std::uint64_t largest = 0;
  for (const package::BlockFiles& block : manifest.blocks) largest = std::max(largest, block.tiles.bytes);
  return std::min<std::uint64_t>(blocks_at_work, manifest.blocks.size()) * largest;
}

/// Four blocks lie two by two at the widest.
double bytes_of_crowns_at_work(const package::Manifest& manifest) {
  if (!manifest.canopy) return 0.0;
  // Trees of parks stand closer than those of streets
  constexpr double uneven = 2.0, blocks_beside = 2.0;
  const Grid& grid = manifest.grid;
  const double around_m = blocks_beside * grid.block_edge * grid.cell_edge_m + 2.0 * CrownMerging{}.farthest_m;
  const auto share_of = [&](std::int64_t cells) {
    return std::min(1.0, around_m / (static_cast<double>(cells) * grid.cell_edge_m));
  };
  const double share = share_of(grid.cells.width()) * share_of(grid.cells.height());
  return std::min(1.0, uneven * share) * static_cast<double>(manifest.canopy->stamp.bytes);
}

bool any_traces_whole_city(const PackageReader& package, Engine engine, std::span<const Cell> cells) {
  return std::any_of(cells.begin(), cells.end(),
                     [&](Cell cell) { return method_of(engine, far_map_of(package, cell)) == EvaluationMethod::whole_city; });
}

RunSettings with_bytes_of_caller(RunSettings run, std::uint64_t bytes) {
  run.caller_bytes += std::min(bytes, std::numeric_limits<std::uint64_t>::max() - run.caller_bytes);
  return run;
}

double require_memory(const package::Manifest& manifest, const ResolvedSettings& settings, const MemoryNeeds& needs) {
  const auto threads = static_cast<double>(settings.threads);
  const double of_receiver = receiver_bytes + static_cast<double>(columns_of(settings.sky.further).size() * sizeof(float));
  const double in_flight = static_cast<double>(cells_in_flight(settings.threads)) * needs.receivers_of_cell * of_receiver;
  const bool has_crowns = uses_crowns(manifest, settings);
  const double of_thread = thread_bytes + (has_crowns ? bytes_of_canopies(manifest, settings) : 0.0);
  const double of_blocks = static_cast<double>(bytes_of_blocks_at_work(manifest)) +
                           (has_crowns ? bytes_of_crowns_at_work(manifest) + bytes_of_canopy_pixels(manifest, settings) : 0.0);
  const double bytes = program_bytes + threads * of_thread + needs.results + static_cast<double>(settings.run.caller_bytes) +
                       in_flight + bytes_of_samples(manifest, settings) + bytes_of_pixels(manifest, settings) + of_blocks;
  const bool has_whole_city = needs.whole_city || traces_whole_city(settings);
  const double in_all = bytes + (has_whole_city ? bytes_of_whole_city(manifest, settings) : 0.0);
  // What is told is enough, whichever of its parts is too large
  if (is_above_limit(bytes, settings.run)) require_below_limit(in_all, settings.run, "this run", take_less);
  require_below_limit(in_all, settings.run, "tracing the whole city", without_whole_city);
  if (settings.dry_run) return in_all;
  if (is_beyond_machine(bytes)) require_below_machine(in_all, settings.run, "this run", take_less);
  require_below_machine(in_all, settings.run, "tracing the whole city", without_whole_city);
  return in_all;
}

EvaluationSummary with_memory(EvaluationSummary summary, double bytes) {
  summary.estimate->memory_bytes = bytes;
  return summary;
}

void require_memory(const RunSettings& run, double bytes, const std::string& what, const std::string& instead) {
  const double threads = static_cast<double>(thread_count(run));
  const double in_all = program_bytes + threads * thread_bytes + static_cast<double>(run.caller_bytes) + bytes;
  require_below_limit(in_all, run, what, instead);
  require_below_machine(in_all, run, what, instead);
}

}  // namespace farlod
