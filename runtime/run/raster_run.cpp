// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/run_settings.hpp"
#include "evaluate/quantity_table.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "farlod/error.hpp"
#include "farlod/raster.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/near_buildings.hpp"
#include "receivers/raster_receivers.hpp"
#include "run/coarser_raster.hpp"
#include "run/memory_limit.hpp"
#include "run/open_tiles.hpp"
#include "run/ordered_run.hpp"
#include "run/svf_statistics.hpp"

namespace farlod {
namespace {

constexpr float no_data = SvfValues::no_data;
constexpr std::size_t pixels_in_tile = raster_tile_edge * raster_tile_edge;
constexpr double most_pixels = 1e11;  // beyond what any machine holds, and below what a count can be

void require_step(double step_m) { require_between("step_m", step_m, 0.01, 10'000.0); }

void require_usable(const RasterPlan& plan) {
  require_step(plan.step_m);
  require_coordinate("north_west_m.x", plan.north_west_m.x);
  require_coordinate("north_west_m.y", plan.north_west_m.y);
  if (plan.columns == 0 || plan.rows == 0) throw InvalidArgument("the raster has no pixels: give a column and a row at least");
  if (static_cast<double>(plan.columns) * static_cast<double>(plan.rows) > most_pixels)
    throw InvalidArgument("the raster has too many pixels: choose a smaller part, or a larger step");
}

void require_usable(const Box2d& part, double step_m) {
  for (const double x : {part.low.x, part.low.y, part.high.x, part.high.y}) require_coordinate("a coordinate of the part", x);
  if (part.low.x >= part.high.x || part.low.y >= part.high.y)
    throw InvalidArgument("the part of the raster is empty: its low corner must lie south-west of its high corner");
  if ((part.high.x - part.low.x) / step_m * ((part.high.y - part.low.y) / step_m) > most_pixels)
    throw InvalidArgument("the raster has too many pixels: choose a smaller part, or a larger step");
}

/// Pixels beyond the grid have answers where horizons can be drawn there: rays against the whole city would take a hundred times
/// as long for bounds and light. It depends on the package alone, so that all engines answer the same pixels.
BeyondGrid beyond_grid_of(const PackageReader& package) {
  return far_map_outside_of_grid(package) == FarMapOfCell::all_is_near ? BeyondGrid::is_answered : BeyondGrid::is_left_out;
}

TileRange tiles_over(const PixelRange& pixels) {
  return {{pixels.row_begin / raster_tile_edge, pixels.column_begin / raster_tile_edge},
          {tiles_along(pixels.row_end), tiles_along(pixels.column_end)}};
}

double pixels_of(const RasterPlan& plan) { return static_cast<double>(plan.columns) * static_cast<double>(plan.rows); }

double pixels_of(const PixelRange& pixels) {
  return static_cast<double>(pixels.column_end - pixels.column_begin) * static_cast<double>(pixels.row_end - pixels.row_begin);
}

std::vector<TileRange> tiles_of_cells(const RasterReceivers& receivers, std::span<const Cell> cells) {
  std::vector<TileRange> tiles;
  tiles.reserve(cells.size());
  for (const Cell cell : cells) tiles.push_back(tiles_over(receivers.range_of(cell)));
  return tiles;
}

MemoryNeeds needs_of(const RasterPlan& plan, std::span<const TileRange> tiles, const Grid& grid, std::size_t bands) {
  const double bytes_of_pixel = static_cast<double>(bands * sizeof(float));
  const double along_edge = std::ceil(grid.cell_edge_m / plan.step_m);
  return {static_cast<double>(OpenTiles::most_open(plan, tiles) * pixels_in_tile) * bytes_of_pixel, along_edge * along_edge};
}

/// The pixels' numbers are the receivers' indices.
void put_values(const CellReceivers& cell, const SvfValues& values, std::size_t columns, OpenTiles& tiles) {
  const bool bounds = !values.low.empty();
  for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
    const std::size_t pixel = cell.receivers[k].index;
    tiles.put(pixel % columns, pixel / columns,
              {values.svf[k], bounds ? values.low[k] : 0.0F, bounds ? values.high[k] : 0.0F, values.further_of(k)});
  }
  tiles.part_done();
}

/// Copies the part of a tile's band that lies within the raster.
void copy_band(const RasterTile& tile, const std::vector<float>& from, const RasterPlan& plan, std::vector<float>& to) {
  const std::size_t row_0 = tile.place.row * raster_tile_edge, column_0 = tile.place.column * raster_tile_edge;
  const std::size_t rows = pixels_of_tile(tile.place.row, plan.rows), columns = pixels_of_tile(tile.place.column, plan.columns);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(row * raster_tile_edge);
    const auto place = static_cast<std::ptrdiff_t>((row_0 + row) * plan.columns + column_0);
    std::copy(begin, begin + static_cast<std::ptrdiff_t>(columns), to.begin() + place);
  }
}

/// The pixels of a raster cell by cell. `store(cell, values)` takes their answers. All must outlive it.
template <class Store>
class PixelCells final : public CellsOfRun {
 public:
  PixelCells(const PackageReader& package, const RasterReceivers& pixels, const std::vector<Cell>& cells, const Placing& placing,
             const ResolvedSettings& settings, const Store& store)
      : package_(package), pixels_(pixels), cells_(cells), placing_(placing), settings_(settings), store_(store) {}

  [[nodiscard]] std::size_t size() const override { return cells_.size(); }
  [[nodiscard]] Cell place(std::size_t n) const override { return cells_[n]; }
  [[nodiscard]] double receivers_about(std::size_t n) const override { return pixels_of(pixels_.range_of(cells_[n])); }
  [[nodiscard]] CellReceivers receivers(std::size_t n) override {
    const float height_m = package_height_m(placing_, package_.manifest());
    const std::stop_token& stop = settings_.run.stop;
    CellReceivers cell = pixels_.in_cell(package_, cells_[n], placing_.above, height_m, stop);
    if (settings_.within_m) leave_out_far(*settings_.within_m, cell);
    if (placing_.above == HeightAbove::ground) cell.is_near_building = are_near_buildings(package_, cell, near_buildings_m, stop);
    return cell;
  }
  void store(std::size_t, const CellReceivers& cell, const SvfValues& values) override { store_(cell, values); }

 private:
  void leave_out_far(double within_m, CellReceivers& cell) const {
    const std::vector<bool> is_near = are_near_buildings(package_, cell, within_m, settings_.run.stop);
    std::vector<Receiver> near;
    for (std::size_t n = 0; n < is_near.size(); ++n)
      if (is_near[n]) near.push_back(cell.receivers[n]);
    cell.outside_of_region += cell.receivers.size() - near.size();
    cell.receivers = std::move(near);
  }

  const PackageReader& package_;
  const RasterReceivers& pixels_;
  const std::vector<Cell>& cells_;
  const Placing& placing_;
  const ResolvedSettings& settings_;
  const Store& store_;
};

/// The run of a raster: what can be refused is refused before there is any memory for answers.
class RasterRun {
 public:
  RasterRun(const Package& package, const RasterPlan& plan, const Placing& placing, const EvaluationSettings& evaluation,
            const RunSettings& run)
      : settings_(resolved(evaluation, run)),
        placing_(resolved(placing)),
        package_(package),
        plan_(checked(plan)),
        receivers_(reader().manifest(), plan, settings_.region.get(), beyond_grid_of(reader())),
        cells_(along_hilbert_curve(receivers_.cells(), reader().grid().block_edge)),
        tiles_(tiles_of_cells(receivers_, cells_)),
        further_bands_(columns_of(settings_.sky.further).size()) {
    MemoryNeeds needs = needs_of(plan_, tiles_, reader().grid(), (settings_.bounds ? 3 : 1) + further_bands_);
    needs.whole_city = any_traces_whole_city(reader(), settings_.sky.engine, cells_);
    memory_bytes_ = require_memory(reader().manifest(), settings_, needs);
  }

  [[nodiscard]] EvaluationSummary evaluate(const OnRasterTile& on_tile) const {
    OpenTiles open_tiles(plan_, settings_.bounds ? RasterBands::svf_and_bounds : RasterBands::svf, further_bands_, tiles_,
                         on_tile);
    std::size_t pixels_in_grid = 0;
    const auto store = [&](const CellReceivers& cell, const SvfValues& values) {
      put_values(cell, values, plan_.columns, open_tiles);
      pixels_in_grid += cell.receivers.size() + cell.left_out;
    };
    PixelCells pixel_cells(reader(), receivers_, cells_, placing_, settings_, store);
    EvaluationSummary summary = evaluate_cells(package_, settings_, pixel_cells);
    if (summary.estimate) return with_memory(std::move(summary), memory_bytes_);
    if (settings_.run.shard) return summary;
    summary.beyond_grid = plan_.columns * plan_.rows - pixels_in_grid - summary.outside_of_region;
    summary.no_data = pixels_in_grid - summary.receivers;
    return summary;
  }

  [[nodiscard]] double memory_bytes() const { return memory_bytes_; }

 private:
  [[nodiscard]] static const RasterPlan& checked(const RasterPlan& plan) {
    require_usable(plan);
    return plan;
  }
  [[nodiscard]] const PackageReader& reader() const { return package_.reader(); }

  ResolvedSettings settings_;
  Placing placing_;
  PackageInUse package_;
  RasterPlan plan_;
  RasterReceivers receivers_;
  std::vector<Cell> cells_;
  std::vector<TileRange> tiles_;
  std::size_t further_bands_;
  double memory_bytes_ = 0.0;
};

/// The estimate of a dry run. Of fine pixels, coarser ones tell what each takes; memory is that of the raster itself.
EvaluationSummary estimate_of_raster(const Package& package, const RasterPlan& plan, const Placing& placing,
                                     const EvaluationSettings& settings, const RunSettings& run) {
  const RasterRun of_all(package, plan, placing, settings, run);
  const std::size_t times = coarsening_of(plan, package.description().cell_edge_m);
  if (times == 1) return of_all.evaluate({});
  const RasterPlan sampled = coarser(plan, times);
  EvaluationSummary summary = RasterRun(package, sampled, placing, settings, run).evaluate({});
  const double ratio = pixels_of(plan) / pixels_of(sampled);
  summary.estimate->receivers *= ratio;
  summary.estimate->seconds *= ratio;
  return with_memory(std::move(summary), of_all.memory_bytes());
}

void require_within(const RasterWindow& window, const RasterPlan& plan) {
  if (window.columns == 0 || window.rows == 0)
    throw InvalidArgument("the window has no pixels: give a column and a row at least");
  if (window.column >= plan.columns || window.columns > plan.columns - window.column || window.row >= plan.rows ||
      window.rows > plan.rows - window.row)
    throw InvalidArgument("the window reaches beyond the raster, which has " + std::to_string(plan.columns) + " columns and " +
                          std::to_string(plan.rows) + " rows");
}

/// A raster in which nothing has a value yet.
Raster empty_raster(const RasterPlan& plan, bool bounds, std::size_t further_bands) {
  const std::size_t count = plan.columns * plan.rows;
  return {plan,
          std::vector<float>(count, no_data),
          std::vector<float>(bounds ? count : 0, no_data),
          std::vector<float>(bounds ? count : 0, no_data),
          std::vector(further_bands, std::vector<float>(count, no_data)),
          {}};
}

std::size_t bytes_of(const RasterPlan& plan, bool bounds, std::size_t further_bands) {
  return plan.columns * plan.rows * ((bounds ? 3 : 1) + further_bands) * sizeof(float);
}

double median_of(std::vector<float> values) {
  std::erase_if(values, [](float value) { return std::isnan(value); });
  SvfDistribution distribution;
  distribution.add(values);
  return distribution.median();
}

/// Pixels of a window of a raster, and how their answers are stored.
class WindowAnswers {
 public:
  WindowAnswers(const RasterPlan& whole, const RasterWindow& window, bool bounds, const Quantities& further)
      : whole_columns_(whole.columns),
        window_(window),
        total_band_(total_columns_of(further).total.value_or(0)),
        raster_(empty_raster(plan_of(whole, window), bounds, columns_of(further).size())) {}

  [[nodiscard]] static RasterPlan plan_of(const RasterPlan& whole, const RasterWindow& window) {
    return {{whole.north_west_m.x + static_cast<double>(window.column) * whole.step_m,
             whole.north_west_m.y - static_cast<double>(window.row) * whole.step_m},
            whole.step_m,
            window.columns,
            window.rows};
  }
  /// Takes the receivers of a cell, which are pixels of the whole raster by their numbers, as far as they lie in the window.
  void store(const CellReceivers& cell, const SvfValues& values) {
    for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
      const std::size_t column = cell.receivers[k].index % whole_columns_ - window_.column;
      const std::size_t row = cell.receivers[k].index / whole_columns_ - window_.row;
      // What lies west or north of the window has wrapped around to a large number
      if (column >= window_.columns || row >= window_.rows) continue;
      put(row * window_.columns + column, values, k);
      if (!cell.is_near_building.empty() && cell.is_near_building[k]) near_buildings_.add(values.svf[k]);
    }
  }
  [[nodiscard]] Raster take(EvaluationSummary summary) {
    const SvfStatistics svf = statistics_of(raster_.svf);
    summary.svf_min = summary.svf_mean = summary.svf_max = summary.svf_median = std::nullopt;
    summary.receivers = svf.count;
    if (const auto range = svf.range()) {
      summary.svf_min = range->min, summary.svf_mean = range->mean, summary.svf_max = range->max;
      summary.svf_median = median_of(raster_.svf);
    }
    store_statistics_near_buildings(near_buildings_, summary);
    summary.further.clear();
    for (const std::vector<float>& band : raster_.further) summary.further.push_back(statistics_of(band).range());
    if (summary.svf_total) summary.svf_total = summary.further[total_band_];
    summary.no_data = raster_.svf.size() - summary.receivers;
    summary.beyond_grid = 0;
    raster_.summary = std::move(summary);
    return std::move(raster_);
  }

 private:
  void put(std::size_t pixel, const SvfValues& values, std::size_t k) {
    raster_.svf[pixel] = values.svf[k];
    if (!values.low.empty()) {
      raster_.low[pixel] = values.low[k];
      raster_.high[pixel] = values.high[k];
    }
    const std::span<const float> further = values.further_of(k);
    for (std::size_t band = 0; band < further.size(); ++band) raster_.further[band][pixel] = further[band];
  }

  std::size_t whole_columns_;
  RasterWindow window_;
  std::size_t total_band_;
  SvfStatistics near_buildings_;
  Raster raster_;
};

bool meet(const PixelRange& pixels, const RasterWindow& window) {
  return pixels.column_begin < window.column + window.columns && window.column < pixels.column_end &&
         pixels.row_begin < window.row + window.rows && window.row < pixels.row_end;
}

std::vector<Cell> cells_in(const RasterWindow& window, const RasterReceivers& receivers, const Grid& grid) {
  std::vector<Cell> cells = receivers.cells();
  std::erase_if(cells, [&](Cell cell) { return !meet(receivers.range_of(cell), window); });
  return along_hilbert_curve(std::move(cells), grid.block_edge);
}

void require_nothing_kept(const RunSettings& run) {
  if (run.answers || run.shard)
    throw InvalidArgument("a window keeps no answers and has no shards: evaluate the raster for that");
}

}  // namespace

RasterTile::RasterTile(TilePlace where, RasterBands bands, std::size_t further_bands)
    : place(where),
      svf(pixels_in_tile, no_data),
      low(bands == RasterBands::svf ? 0 : pixels_in_tile, no_data),
      high(low),
      further(further_bands, svf) {}

RasterPlan plan_raster(const Package& package, double step_m, const std::optional<Box2d>& part) {
  const PackageInUse in_use(package);
  require_step(step_m);
  if (part) require_usable(*part, step_m);
  return plan_raster(in_use.reader().manifest(), step_m, part);
}

std::optional<RasterPlan> plan_of_surface_model(const Package& package, const std::optional<Box2d>& part) {
  const PackageInUse in_use(package);
  const auto& pixels = in_use.reader().manifest().pixels;
  if (!pixels) return std::nullopt;
  const RasterPlan whole{pixels->north_west_m, pixels->step_m, pixels->columns, pixels->rows};
  if (!part) return whole;
  require_usable(*part, whole.step_m);
  const Point2d corner = whole.north_west_m;
  const double east_m = corner.x + static_cast<double>(whole.columns) * whole.step_m,
               south_m = corner.y - static_cast<double>(whole.rows) * whole.step_m;
  if (part->high.x <= corner.x || part->low.x >= east_m || part->low.y >= corner.y || part->high.y <= south_m)
    throw InvalidArgument("the part of the raster lies beyond the raster that the city is: check its coordinates");
  return plan_within(whole, *part);
}

EvaluationSummary evaluate_raster(const Package& package, const RasterPlan& plan, const Placing& placing,
                                  const EvaluationSettings& settings, const OnRasterTile& on_tile, const RunSettings& run) {
  if (!on_tile) throw InvalidArgument("nobody takes the tiles: give evaluate_raster a function that does");
  if (settings.dry_run) return estimate_of_raster(package, plan, placing, settings, run);
  return RasterRun(package, plan, placing, settings, run).evaluate(on_tile);
}

Raster evaluate_raster(const Package& package, const RasterPlan& plan, const Placing& placing, const EvaluationSettings& settings,
                       const RunSettings& run) {
  require_usable(plan);
  const std::size_t further_bands = columns_of(settings.further).size();
  const RasterRun raster_run(package, plan, placing, settings,
                             with_bytes_of_caller(run, bytes_of(plan, settings.bounds, further_bands)));
  Raster raster = empty_raster(plan, settings.bounds, further_bands);
  const auto copy_tile = [&raster](const RasterTile& tile) {
    copy_band(tile, tile.svf, raster.plan, raster.svf);
    for (std::size_t n = 0; n < tile.further.size(); ++n) copy_band(tile, tile.further[n], raster.plan, raster.further[n]);
    if (tile.low.empty()) return;
    copy_band(tile, tile.low, raster.plan, raster.low);
    copy_band(tile, tile.high, raster.plan, raster.high);
  };
  raster.summary = raster_run.evaluate(copy_tile);
  return raster;
}

Raster evaluate_window(const Package& package, const RasterPlan& plan, const RasterWindow& window, const Placing& placing,
                       const EvaluationSettings& settings, const RunSettings& run) {
  require_usable(plan);
  require_within(window, plan);
  require_nothing_kept(run);
  const std::size_t further_bands = columns_of(settings.further).size();
  const std::size_t bytes = bytes_of(WindowAnswers::plan_of(plan, window), settings.bounds, further_bands);
  const ResolvedSettings resolved_settings = resolved(settings, with_bytes_of_caller(run, bytes));
  const Placing where = resolved(placing);
  const PackageInUse in_use(package);
  const package::Manifest& manifest = in_use.reader().manifest();
  const RasterReceivers receivers(manifest, plan, resolved_settings.region.get(), beyond_grid_of(in_use.reader()));
  const std::vector<Cell> cells = cells_in(window, receivers, in_use.reader().grid());
  MemoryNeeds needs = needs_of(plan, {}, in_use.reader().grid(), 0);
  needs.whole_city = any_traces_whole_city(in_use.reader(), resolved_settings.sky.engine, cells);
  const double memory_bytes = require_memory(manifest, resolved_settings, needs);
  WindowAnswers answers(plan, window, settings.bounds, settings.further);
  const auto store = [&](const CellReceivers& cell, const SvfValues& values) { answers.store(cell, values); };
  PixelCells pixel_cells(in_use.reader(), receivers, cells, where, resolved_settings, store);
  EvaluationSummary summary = evaluate_cells(in_use, resolved_settings, pixel_cells);
  if (summary.estimate) summary = with_memory(std::move(summary), memory_bytes);
  return answers.take(std::move(summary));
}

}  // namespace farlod
