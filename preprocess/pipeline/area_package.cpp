// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/area_package.hpp"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include "align/area_cells.hpp"
#include "contract/cancellation.hpp"
#include "contract/expects.hpp"
#include "farlod/error.hpp"
#include "farmap/far_map_baker.hpp"
#include "package/package_writer.hpp"

namespace farlod::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

georeference::RequestedArea requested(const FarMapArea& area) {
  if (const auto* file = std::get_if<std::filesystem::path>(&area)) return georeference::read_area(*file);
  return {"The area", {{area_of(std::get<Box2d>(area)), {}}}};
}

std::string extent_text(const Box2d& box, Point2d origin) {
  return fmt::format("from {:.1f},{:.1f} to {:.1f},{:.1f}", box.low.x + origin.x, box.low.y + origin.y, box.high.x + origin.x,
                     box.high.y + origin.y);
}

/// The outline of a grid in the city frame.
Box2d outline_of_grid(const Grid& grid) {
  const auto [low, high] = grid.rectangle();
  Box2d outline;
  for (const Point2d corner : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}})
    outline.add(grid.rotation.city_from_grid(corner));
  return outline;
}

/// The cells of the block that have far maps afterwards; absent where all have one.
std::optional<package::CellRuns> with_existing(std::vector<std::size_t> places, const package::BlockFiles* there,
                                               std::size_t cell_count) {
  if (there != nullptr && !there->mapped) return std::nullopt;
  if (there != nullptr) {
    const std::vector<std::size_t> old = there->mapped->places();
    places.insert(places.end(), old.begin(), old.end());
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (places.size() == cell_count) return std::nullopt;
  return package::CellRuns::of(places);
}

std::size_t count_of(const PlannedBlock& planned, const Grid& grid) {
  return planned.mapped ? planned.mapped->size() : static_cast<std::size_t>(grid.cells_of(planned.block).size());
}

/// From what far maps are baked.
struct BakingSettings {
  Assign assign;
  FarMapSettings far_map;
};

/// Bakes and writes blocks. Any number of them at once.
class BlockWriting {
 public:
  BlockWriting(const TileSet& tiles, const package::Manifest& manifest, BakingSettings baking, PackageWriter& writer,
               const RunSettings& run)
      : tiles_(tiles), manifest_(manifest), grid_(manifest.grid), baking_(baking), writer_(writer), run_(run) {}

  /// Before blocks that need far maps are written.
  void index_city() {
    baker_.emplace(tiles_, grid_, baking_.assign, baking_.far_map);
    tiles_.let_go();
  }

  package::BlockFiles write(const PlannedBlock& planned) {
    throw_if_cancelled(run_.stop);
    const auto start = Clock::now();
    const bool has_maps = count_of(planned, grid_) > 0;
    // While a thread waits for the cells of its block, it must not begin another block, which would be held beside it
    const BakedBlock maps = has_maps ? oneapi::tbb::this_task_arena::isolate([&] { return bake(planned); }) : BakedBlock{};
    bake_s_ += seconds_since(start);
    const auto baked = Clock::now();
    package::BlockFiles files = writer_.write_block(tiles_, maps, grid_, planned.block, manifest_.far_map, planned.mapped);
    tiles_.let_go(grid_.cells_of(planned.block));
    write_s_ += seconds_since(baked);
    return files;
  }

  /// Of the wall clock, the shares of baking and of writing in the time of all threads.
  [[nodiscard]] std::pair<double, double> divided(double wall_s) const {
    const double busy_s = bake_s_ + write_s_;
    const double bake_share = busy_s > 0.0 ? bake_s_ / busy_s : 0.0;
    return {wall_s * bake_share, wall_s * (1.0 - bake_share)};
  }

 private:
  [[nodiscard]] BakedBlock bake(const PlannedBlock& planned) const {
    FARLOD_EXPECTS(baker_.has_value());
    return planned.mapped ? baker_->bake(planned.block, *planned.mapped, run_.stop) : baker_->bake(planned.block, run_.stop);
  }

  const TileSet& tiles_;
  const package::Manifest& manifest_;
  const Grid& grid_;
  BakingSettings baking_;
  PackageWriter& writer_;
  const RunSettings& run_;
  std::optional<FarMapBaker> baker_;
  std::atomic<double> bake_s_ = 0.0, write_s_ = 0.0;
};

/// Tells how many blocks are done, one call at a time.
class BlockProgress {
 public:
  BlockProgress(const RunSettings& run, std::size_t all) : run_(run), all_(all) { tell(); }
  void add_one() {
    const std::lock_guard lock(mutex_);
    ++done_;
    tell();
  }

 private:
  void tell() const {
    if (run_.on_progress) run_.on_progress({"far maps", done_, all_});
  }
  const RunSettings& run_;
  std::size_t all_, done_ = 0;
  std::mutex mutex_;
};

/// At most so many blocks are in work at a time.
std::vector<package::BlockFiles> write_blocks(const AreaPlan& plan, BlockWriting& writing, const RunSettings& run,
                                              std::size_t blocks_at_once) {
  std::vector<package::BlockFiles> files(plan.blocks.size());
  BlockProgress progress(run, files.size());
  std::atomic<std::size_t> next = 0;
  const auto write_next_ones = [&](std::size_t) {
    for (std::size_t n = next++; n < files.size(); n = next++) {
      const PlannedBlock& planned = plan.blocks[n];
      files[n] = planned.kept ? *planned.kept : writing.write(planned);
      progress.add_one();
    }
  };
  oneapi::tbb::parallel_for(std::size_t{0}, std::min(blocks_at_once, files.size()), write_next_ones,
                            oneapi::tbb::simple_partitioner());
  return files;
}

/// Of the files of the package on disk.
std::uint64_t bytes_on_disk(const std::filesystem::path& folder, const package::Manifest& manifest) {
  std::error_code unread;
  const std::uintmax_t of_manifest = std::filesystem::file_size(folder / package::manifest_file, unread);
  std::uint64_t bytes = unread ? 0 : of_manifest;
  for (const package::BlockFiles& b : manifest.blocks) bytes += b.tiles.bytes + b.far_map.bytes;
  return bytes;
}

}  // namespace

AreaPlan plan_area(const georeference::RequestedArea& area, const Georeference& georeference, const Grid& grid,
                   const ExistingPackage* existing) {
  const Area area_city = georeference::located(area, georeference);
  const align::AreaCells met = align::cells_met_by(area_city, grid);
  if (met.cells.empty())
    throw InvalidArgument(area.name + " meets no cell of the grid: it reaches " +
                          extent_text(outline_of(area_city), georeference.origin_m) + ", and the city " +
                          extent_text(outline_of_grid(grid), georeference.origin_m) + " (" + georeference.crs_name +
                          "): check its coordinates, and their CRS");
  std::map<Block, std::vector<std::size_t>> places;
  for (const Cell cell : met.cells) {
    const Block block = grid.block_of(cell);
    places[block].push_back(grid.cells_of(block).index_of(cell));
  }
  AreaPlan plan{{}, 0, met.shapes_outside_of_grid};
  const std::vector<Block> blocks = grid.blocks();
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const package::BlockFiles* there = existing != nullptr ? &existing->blocks()[n] : nullptr;
    const auto cell_count = static_cast<std::size_t>(grid.cells_of(blocks[n]).size());
    PlannedBlock planned{blocks[n], with_existing(places[blocks[n]], there, cell_count)};
    if (there != nullptr && there->mapped == planned.mapped) planned.kept = *there;
    if (!planned.kept) plan.far_maps += count_of(planned, grid);
    plan.blocks.push_back(std::move(planned));
  }
  return plan;
}

AreaPackage::AreaPackage(const StageSettings& settings) : settings_(&settings) {
  if (settings.overwrite == Overwrite::refuse) existing_ = ExistingPackage::find(settings.output);
  if (!existing_) require_room(settings.output, settings.overwrite);
  area_ = requested(*settings.area);
}

void AreaPackage::plan(const Georeference& georeference, PackedCity& result) {
  const package::Manifest& manifest = result.manifest;
  if (existing_) existing_->require_same(manifest, Known::before_tiles);
  plan_ = plan_area(area_, georeference, manifest.grid, existing_ ? &*existing_ : nullptr);
  if (plan_.shapes_outside_of_grid > 0)
    result.notes.push_back("Shapes of the area that meet no cell of the grid: " + std::to_string(plan_.shapes_outside_of_grid));
  if (plan_.far_maps == 0) result.notes.emplace_back("All cells of the area have far maps already");
}

void AreaPackage::require_same_city(const package::Manifest& manifest) const {
  if (existing_) existing_->require_same(manifest, Known::all);
}

void AreaPackage::write(const TileSet& tiles, const FarMapSettings& far_map, PackedCity& result, const RunSettings& run,
                        std::size_t blocks_at_once) const {
  package::Manifest& manifest = result.manifest;
  const auto timed = [&](const std::string& stage, const auto& work) {
    throw_if_cancelled(run.stop);
    if (run.on_progress) run.on_progress({stage, 0, 1});
    const auto start = Clock::now();
    work();
    result.stage_seconds.emplace_back(stage, seconds_since(start));
  };
  if (existing_) timed("compare", [&] { existing_->require_same_tiles(tiles, manifest.grid); });
  PackageWriter writer =
      existing_ ? PackageWriter::adding_to(settings_->output) : PackageWriter(settings_->output, settings_->overwrite);
  BlockWriting writing(tiles, manifest, {settings_->assign, far_map}, writer, run);
  if (plan_.far_maps > 0) timed("city_index", [&] { writing.index_city(); });
  const auto start = Clock::now();
  manifest.blocks = write_blocks(plan_, writing, run, blocks_at_once);
  if (existing_) existing_->require_unchanged();
  throw_if_cancelled(run.stop);
  writer.finish(manifest);
  const auto [bake_s, write_s] = writing.divided(seconds_since(start));
  result.stage_seconds.emplace_back("far_maps", bake_s);
  result.stage_seconds.emplace_back("package", write_s);
  result.package_bytes = bytes_on_disk(settings_->output, manifest);
  result.far_map_bytes = writer.far_map_bytes();
}

std::optional<AreaPackage> prepare_output(const StageSettings& settings) {
  if (settings.area) return AreaPackage(settings);
  require_room(settings.output, settings.overwrite);
  return std::nullopt;
}

}  // namespace farlod::pipeline
