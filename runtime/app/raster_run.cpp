// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/evaluation.hpp"
#include "app/memory_limit.hpp"
#include "receivers/hilbert_curve.hpp"
#include "receivers/raster_receivers.hpp"
#include "results/raster/open_tiles.hpp"

namespace farlod {
namespace {

struct OutputFile {
  const OutputFormat* format;
  std::filesystem::path path;
};

std::vector<OutputFile> output_files(const SvfOptions& options) {
  std::vector<OutputFile> files{{options.format, options.output}};
  if (!options.preview_file.empty()) files.push_back({options.preview_format, options.preview_file});
  return files;
}

/// The files of a raster run, which are written tile by tile while its cells are evaluated.
class RasterFiles {
 public:
  RasterFiles(const RasterFrame& frame, const SvfOptions& options) {
    for (const OutputFile& file : output_files(options)) {
      writers_.push_back(file.format->raster_writer(frame, file.path));
      paths_.push_back(file.path);
    }
  }

  void write(const RasterTile& tile) const {
    for (const auto& writer : writers_) writer->write(tile);
  }
  [[nodiscard]] const std::vector<std::filesystem::path>& commit() const {
    for (const auto& writer : writers_) writer->commit();
    return paths_;
  }

 private:
  std::vector<std::unique_ptr<RasterWriter>> writers_;
  std::vector<std::filesystem::path> paths_;
};

TileRange tiles_over(const PixelRange& pixels) {
  return {{pixels.row_begin / raster_tile_edge, pixels.column_begin / raster_tile_edge},
          {tiles_along(pixels.row_end), tiles_along(pixels.column_end)}};
}

std::vector<TileRange> tiles_of_cells(const RasterReceivers& receivers, std::span<const Cell> cells) {
  std::vector<TileRange> tiles;
  tiles.reserve(cells.size());
  for (const Cell cell : cells) tiles.push_back(tiles_over(receivers.range_of(cell)));
  return tiles;
}

MemoryNeeds needs_of(const RasterFrame& frame, std::span<const TileRange> tiles, const Grid& grid, const SvfOptions& options) {
  const std::uint64_t bytes_of_pixel = (frame.bands == RasterBands::svf ? 1 : 3) * sizeof(float);
  MemoryNeeds needs;
  needs.results = OpenTiles::most_open(frame, tiles) * raster_tile_edge * raster_tile_edge * bytes_of_pixel;
  for (const OutputFile& file : output_files(options)) needs.results += file.format->raster_writer_bytes(frame);
  const double along_edge = std::ceil(grid.cell_edge_m / frame.step_m);
  needs.receivers_of_cell = static_cast<std::uint64_t>(along_edge * along_edge);
  return needs;
}

RasterFrame frame_of(const RasterPlan& plan, const SvfOptions& options, const package::Manifest& manifest) {
  return {plan.north_west_m,
          plan.step_m,
          plan.columns,
          plan.rows,
          options.bounds ? RasterBands::svf_and_bounds : RasterBands::svf,
          quantity_name(options.sky.weight),
          manifest.crs_wkt,
          manifest.epsg};
}

/// A run over the pixels of a raster.
class RasterRun {
 public:
  RasterRun(Package& package, const SvfOptions& options)
      : package_(package),
        options_(options),
        plan_(plan_raster(package.manifest(), options.grid_step_m, options.bbox_projected)),
        frame_(frame_of(plan_, options, package.manifest())),
        receivers_(package.manifest(), plan_),
        cells_(along_hilbert_curve(receivers_.cells(), package.grid().block_edge)),
        tiles_of_cells_(tiles_of_cells(receivers_, cells_)) {
    share_memory(package, options, needs_of(frame_, tiles_of_cells_, package.grid(), options));
    files_.emplace(frame_, options);
    open_tiles_.emplace(frame_, tiles_of_cells_, [this](const RasterTile& tile) { files_->write(tile); });
  }

  [[nodiscard]] std::size_t cell_count() const { return cells_.size(); }
  [[nodiscard]] CellReceivers receivers_of(std::size_t n) const {
    return receivers_.in_cell(package_, cells_[n], options_.height_above, static_cast<float>(options_.height_m));
  }
  void store(std::size_t n, const CellReceivers& cell, const SvfValues& values) {
    const bool bounds = !values.low.empty();
    for (std::size_t k = 0; k < cell.receivers.size(); ++k) {
      const std::size_t pixel = cell.receivers[k].index;
      open_tiles_->put(pixel % plan_.columns, pixel / plan_.columns,
                       {values.svf[k], bounds ? values.low[k] : 0.0F, bounds ? values.high[k] : 0.0F});
    }
    open_tiles_->part_done();
    pixels_in_grid_ += receivers_.pixel_count(cells_[n]);
  }
  void finish(SvfRun& run) const {
    run.beyond_grid = plan_.columns * plan_.rows - pixels_in_grid_;
    run.inside_buildings = pixels_in_grid_ - run.receivers;
    run.files = files_->commit();
  }

 private:
  const Package& package_;
  const SvfOptions& options_;
  RasterPlan plan_;
  RasterFrame frame_;
  RasterReceivers receivers_;
  std::vector<Cell> cells_;
  std::vector<TileRange> tiles_of_cells_;
  std::optional<RasterFiles> files_;
  std::optional<OpenTiles> open_tiles_;
  std::size_t pixels_in_grid_ = 0;
};

}  // namespace

SvfRun run_raster(Package& package, const SvfOptions& options) {
  RasterRun raster(package, options);
  return evaluate_and_finish(package, options, raster);
}

}  // namespace farlod
