// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/blocks.hpp"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "base/grid_outline.hpp"
#include "farlod/error.hpp"
#include "package/package_writer.hpp"
#include "pipeline/pack_estimate.hpp"

namespace farlod::pipeline {
namespace {

/// A range of numbers, closed.
struct Range {
  double low, high;

  [[nodiscard]] Range within(const Range& o) const { return {std::max(low, o.low), std::min(high, o.high)}; }
  [[nodiscard]] bool empty() const { return !(low <= high); }
};

Range range_of(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

/// Marks cells of a grid. All coordinates are in the grid frame.
class CellMarker {
 public:
  explicit CellMarker(const Grid& grid)
      : grid_(grid), is_met_(static_cast<std::size_t>(grid.cells.size()), false), rectangle_(grid.rectangle()) {}

  /// Returns whether the shape meets a cell, as do the other two.
  bool mark_point(Point2d p) {
    if (!rectangle_.contains(p)) return false;
    return mark(grid_.cell_of(p));
  }
  bool mark_line(const Area::Line& line) {
    // A line of a single point is that point
    bool any = line.size() == 1 && mark_point(line.front());
    for (std::size_t k = 1; k < line.size(); ++k) any |= mark_segment(line[k - 1], line[k]);
    return any;
  }
  bool mark_polygon(const Area::Polygon& polygon) {
    bool any = false;
    for (const Area::Line& ring : polygon) {
      any |= mark_line(ring);
      if (!ring.empty()) any |= mark_segment(ring.back(), ring.front());
    }
    // No ring runs through any other cell: it is covered whole where its centre is
    for (std::int32_t j = grid_.cells.j_begin; j < grid_.cells.j_end; ++j) any |= mark_covered(polygon, j);
    return any;
  }
  [[nodiscard]] std::vector<Cell> marked() const {
    std::vector<Cell> cells;
    for (std::size_t n = 0; n < is_met_.size(); ++n)
      if (is_met_[n]) cells.push_back(grid_.cells.cell_at(n));
    return cells;
  }

 private:
  bool mark(Cell cell) {
    // The rectangle is closed at its east and north, cells are not
    if (!grid_.cells.contains(cell)) return false;
    is_met_[grid_.cells.index_of(cell)] = true;
    return true;
  }

  bool mark_segment(Point2d a, Point2d b) {
    const Range y = range_of(a.y, b.y).within({rectangle_.low.y, rectangle_.high.y});
    if (y.empty()) return false;
    bool any = false;
    for (std::int32_t j = grid_.interval_of(y.low); j <= grid_.interval_of(y.high); ++j) {
      const Range in_row = y.within({grid_.border_m(j), grid_.border_m(j + 1)});
      any |= mark_row(j, a.y == b.y ? range_of(a.x, b.x) : range_of(x_at(in_row.low, a, b), x_at(in_row.high, a, b)));
    }
    return any;
  }
  bool mark_row(std::int32_t j, const Range& of_segment) {
    const Range x = of_segment.within({rectangle_.low.x, rectangle_.high.x});
    bool any = false;
    if (x.empty()) return any;
    for (std::int32_t i = grid_.interval_of(x.low); i <= grid_.interval_of(x.high); ++i) any |= mark({i, j});
    return any;
  }
  static double x_at(double y, Point2d a, Point2d b) {
    return std::clamp(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), std::min(a.x, b.x), std::max(a.x, b.x));
  }

  /// Marks the cells of a row whose centres lie within the polygon.
  bool mark_covered(const Area::Polygon& polygon, std::int32_t j) {
    const double y = grid_.centre_of({0, j}).y;
    std::vector<double> crossings;
    for (const Area::Line& ring : polygon)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point2d a = ring[k], b = ring[(k + 1) % ring.size()];
        if ((a.y <= y) != (b.y <= y)) crossings.push_back(x_at(y, a, b));
      }
    std::sort(crossings.begin(), crossings.end());
    bool any = false;
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) any |= mark_centres(j, {crossings[k], crossings[k + 1]});
    return any;
  }
  bool mark_centres(std::int32_t j, const Range& between) {
    const Range x = between.within({rectangle_.low.x, rectangle_.high.x});
    bool any = false;
    if (x.empty()) return any;
    for (std::int32_t i = grid_.interval_of(x.low); i <= grid_.interval_of(x.high); ++i) {
      const double centre = grid_.centre_of({i, j}).x;
      if (x.low <= centre && centre <= x.high) any |= mark({i, j});
    }
    return any;
  }

  const Grid& grid_;
  std::vector<bool> is_met_;
  Box2d rectangle_;
};

}  // namespace

AreaCells cells_met_by(const Area& area_city, const Grid& grid) {
  Area area = area_city;
  area.for_each_point([&](Point2d& p) { p = grid.rotation.grid_from_city(p); });
  CellMarker marker(grid);
  std::size_t met = 0;
  for (const Point2d p : area.points) met += marker.mark_point(p) ? 1 : 0;
  for (const Area::Line& line : area.lines) met += marker.mark_line(line) ? 1 : 0;
  for (const Area::Polygon& polygon : area.polygons) met += marker.mark_polygon(polygon) ? 1 : 0;
  return {marker.marked(), area.shape_count() - met};
}

namespace {

std::string extent_text(const Box2d& box, Point2d origin) {
  return fmt::format("from {:.1f},{:.1f} to {:.1f},{:.1f}", box.low.x + origin.x, box.low.y + origin.y, box.high.x + origin.x,
                     box.high.y + origin.y);
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

/// `mapped_of(n, block, there)`: the cells of the n-th block that have far maps afterwards.
template <class MappedOf>
BlockPlan plan_blocks(const Grid& grid, const ExistingPackage* existing, const MappedOf& mapped_of) {
  BlockPlan plan;
  const std::vector<Block> blocks = grid.blocks();
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const package::BlockFiles* there = existing != nullptr ? &existing->blocks()[n] : nullptr;
    PlannedBlock planned{blocks[n], mapped_of(blocks[n], there)};
    if (there != nullptr && there->mapped == planned.mapped && existing->is_whole(*there)) planned.kept = *there;
    if (!planned.kept) plan.far_maps += far_maps_of(planned, grid);
    plan.blocks.push_back(std::move(planned));
  }
  return plan;
}

/// Writing a triangle of the tiles on one core. Measured as those of pack_estimate.cpp.
constexpr double seconds_per_written_triangle = 5e-7;

}  // namespace

std::size_t far_maps_of(const PlannedBlock& planned, const Grid& grid) {
  return planned.mapped ? planned.mapped->size() : static_cast<std::size_t>(grid.cells_of(planned.block).size());
}

BlockPlan plan_all(const Grid& grid, const ExistingPackage* existing) {
  return plan_blocks(grid, existing,
                     [](Block, const package::BlockFiles*) -> std::optional<package::CellRuns> { return std::nullopt; });
}

BlockPlan plan_none(const Grid& grid, const ExistingPackage* existing) {
  return plan_blocks(grid, existing, [&](Block block, const package::BlockFiles* there) {
    return with_existing({}, there, static_cast<std::size_t>(grid.cells_of(block).size()));
  });
}

BlockPlan plan_area(const georeference::RequestedArea& area, const Georeference& georeference, const Grid& grid,
                    const ExistingPackage* existing) {
  const Area area_city = georeference::located(area, georeference);
  const AreaCells met = cells_met_by(area_city, grid);
  if (met.cells.empty())
    throw InvalidArgument(area.name + " meets no cell of the grid: it reaches " +
                          extent_text(outline_of(area_city), georeference.origin_m) + ", and the city " +
                          extent_text(outline_city(grid), georeference.origin_m) + " (" + georeference.crs_name +
                          "): check its coordinates, and their CRS");
  std::map<Block, std::vector<std::size_t>> places;
  for (const Cell cell : met.cells) {
    const Block block = grid.block_of(cell);
    places[block].push_back(grid.cells_of(block).index_of(cell));
  }
  BlockPlan plan = plan_blocks(grid, existing, [&](Block block, const package::BlockFiles* there) {
    return with_existing(places[block], there, static_cast<std::size_t>(grid.cells_of(block).size()));
  });
  plan.shapes_outside_of_grid = met.shapes_outside_of_grid;
  return plan;
}

std::vector<double> costs_of(const BlockPlan& plan, const TileSet& tiles, const Grid& grid) {
  std::vector<double> costs;
  for (const PlannedBlock& planned : plan.blocks) {
    double cost = seconds_per_far_map * static_cast<double>(far_maps_of(planned, grid));
    const CellRange cells = grid.cells_of(planned.block);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
      cost += seconds_per_written_triangle * static_cast<double>(tiles.tile(cells.cell_at(n)).triangles.size());
    costs.push_back(planned.kept ? 0.0 : cost);
  }
  return costs;
}

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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

/// Bakes and writes blocks. Any number of them at once.
class BlockMaking {
 public:
  BlockMaking(const BlockSource& source, const UnfinishedPackage& unfinished, const RunSettings& run)
      : source_(source), unfinished_(unfinished), run_(run), writer_(unfinished.package_folder()) {}

  void make(const PlannedBlock& planned) {
    throw_if_cancelled(run_.stop);
    if (unfinished_.finished(planned.block, planned.mapped)) {
      ++found_;
      return;
    }
    const auto start = Clock::now();
    const bool has_maps = far_maps_of(planned, source_.grid) > 0;
    // While a thread waits for the cells of its block, it must not begin another block, which would be held beside it
    const BakedBlock maps = has_maps ? oneapi::tbb::this_task_arena::isolate([&] { return bake(planned); }) : BakedBlock{};
    bake_s_ += seconds_since(start);
    const auto baked = Clock::now();
    unfinished_.record(writer_.write_block(source_.tiles, maps, source_.grid, planned.block, source_.shape, planned.mapped));
    source_.tiles.let_go(source_.grid.cells_of(planned.block));
    write_s_ += seconds_since(baked);
  }

  [[nodiscard]] BlockTally tally(double wall_s) const {
    const double busy_s = bake_s_ + write_s_;
    const double bake_share = busy_s > 0.0 ? bake_s_ / busy_s : 0.0;
    return {wall_s * bake_share, wall_s * (1.0 - bake_share), writer_.far_map_bytes(), found_};
  }

 private:
  [[nodiscard]] BakedBlock bake(const PlannedBlock& planned) const {
    FARLOD_EXPECTS(source_.baker != nullptr);
    return planned.mapped ? source_.baker->bake(planned.block, *planned.mapped, run_.stop)
                          : source_.baker->bake(planned.block, run_.stop);
  }

  const BlockSource& source_;
  const UnfinishedPackage& unfinished_;
  const RunSettings& run_;
  PackageWriter writer_;
  std::atomic<double> bake_s_ = 0.0, write_s_ = 0.0;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace

BlockTally make_blocks(const BlockSource& source, const BlockPlan& plan, std::span<const std::size_t> places,
                       const UnfinishedPackage& unfinished, const RunSettings& run, std::size_t blocks_at_once) {
  const auto start = Clock::now();
  BlockMaking making(source, unfinished, run);
  BlockProgress progress(run, places.size());
  std::atomic<std::size_t> next = 0;
  const auto make_next_ones = [&](std::size_t) {
    for (std::size_t n = next++; n < places.size(); n = next++) {
      if (const PlannedBlock& planned = plan.blocks[places[n]]; !planned.kept) making.make(planned);
      progress.add_one();
    }
  };
  oneapi::tbb::parallel_for(std::size_t{0}, std::min(blocks_at_once, places.size()), make_next_ones,
                            oneapi::tbb::simple_partitioner());
  return making.tally(seconds_since(start));
}

}  // namespace farlod::pipeline
