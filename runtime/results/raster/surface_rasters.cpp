// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/surface_rasters.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "farlod/inspection.hpp"
#include "farlod/plan_view.hpp"
#include "results/gdal_files.hpp"
#include "results/raster/raster_writers.hpp"
#include "results/raster/wall_pixels.hpp"

namespace farlod {
namespace {

/// A file that is written row of tiles by row of tiles.
class RasterOfRows {
 public:
  RasterOfRows(RasterFrame frame, const std::filesystem::path& folder, Band band) : columns_(frame.columns) {
    const std::filesystem::path path = folder / (band.name + ".tif");
    frame.bands = {std::move(band)};
    writer_ = gdal_files().geotiff(frame, path);
  }
  /// Whole rows of the raster, of a row of tiles.
  void write(std::size_t tile_row, std::span<const float> values) {
    const std::size_t rows = values.size() / columns_;
    for (std::size_t column = 0; column < tiles_along(columns_); ++column) {
      RasterTile tile({tile_row, column}, RasterBands::svf);
      for (std::size_t row = 0; row < rows; ++row)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(row * columns_ + column * raster_tile_edge),
                    pixels_of_tile(column, columns_), tile.svf.begin() + static_cast<std::ptrdiff_t>(row * raster_tile_edge));
      writer_->write(tile);
    }
  }
  void commit() {
    writer_->commit();
    writer_.reset();
  }

 private:
  std::size_t columns_;
  std::unique_ptr<RasterWriter> writer_;
};

/// Some rows of a raster, and those around them that their walls depend on.
struct Strip {
  std::size_t first_row = 0, rows = 0, rows_before = 0;
  RasterPlan plan;  ///< of all of them
};

Strip strip_of(const RasterFrame& frame, std::size_t tile_row) {
  const std::size_t first = tile_row * raster_tile_edge, rows = pixels_of_tile(tile_row, frame.rows);
  const std::size_t around = aspect_reach(frame.step_m) + 1, before = std::min(first, around);
  const std::size_t end = std::min(frame.rows, first + rows + around);
  const double north_m = frame.north_west_m.y - static_cast<double>(first - before) * frame.step_m;
  return {first, rows, before, {{frame.north_west_m.x, north_m}, frame.step_m, frame.columns, end - (first - before)}};
}

/// Above the surface; 0 where there is no crown, or none of it is above.
std::vector<float> above_surface(std::span<const float> crown_m, std::span<const float> surface_m) {
  std::vector<float> above_m(crown_m.size());
  std::ranges::transform(crown_m, surface_m, above_m.begin(),
                         [](float crown, float surface) { return std::fmax(0.0F, crown - surface); });
  return above_m;
}

class SurfaceRasters {
 public:
  SurfaceRasters(const RasterFrame& frame, const std::filesystem::path& folder)
      : frame_(frame), folder_(folder), has_trees_(inventory_of(*frame.package).crowns.all() > 0) {
    run_.threads = frame.threads;
    add("dsm", "m", "height of the highest solid surface above sea level");
    add("wall_height", "m", "height of the wall that stands on the pixel, beside a higher one");
    add("wall_aspect", "degree", "azimuth that this wall faces, clockwise from the north of the raster; 0 without a wall");
    if (!plan_of_surface_model(*frame.package)) add("dem", "m", "height of the ground above sea level");
    if (!has_trees_) return;
    add("cdsm", "m", "height of the tops of crowns above dsm; 0 where there are none");
    add("tdsm", "m", "height of the bottoms of crowns above dsm; 0 where there are none");
  }
  void write() {
    for (std::size_t tile_row = 0; tile_row < tiles_along(frame_.rows); ++tile_row) write(tile_row);
    for (auto& [name, file] : files_) file->commit();
  }

 private:
  void add(const std::string& name, const std::string& unit, const std::string& definition) {
    files_.emplace_back(name, std::make_unique<RasterOfRows>(frame_, folder_, Band{name, unit, definition}));
  }
  void write(std::size_t tile_row) {
    const Strip strip = strip_of(frame_, tile_row);
    const PlanHeights heights = plan_heights(*frame_.package, strip.plan, run_);
    const WallSurface surface{strip.plan.columns, strip.plan.rows, strip.plan.step_m, heights.highest_m};
    const std::vector<float> wall_m = wall_heights(surface);
    write(tile_row, strip, "dsm", heights.highest_m);
    write(tile_row, strip, "dem", heights.ground_m);
    write(tile_row, strip, "wall_height", wall_m);
    write(tile_row, strip, "wall_aspect", wall_aspects(surface, wall_m));
    if (!has_trees_) return;
    const PlanCanopy canopy = plan_canopy(*frame_.package, strip.plan, run_);
    write(tile_row, strip, "cdsm", above_surface(canopy.top_m, heights.highest_m));
    write(tile_row, strip, "tdsm", above_surface(canopy.bottom_m, heights.highest_m));
  }
  /// To the file of this name, if there is one.
  void write(std::size_t tile_row, const Strip& strip, const std::string& name, std::span<const float> values) {
    for (auto& [other, file] : files_)
      if (other == name) file->write(tile_row, values.subspan(strip.rows_before * frame_.columns, strip.rows * frame_.columns));
  }

  const RasterFrame& frame_;
  std::filesystem::path folder_;
  bool has_trees_;
  RunSettings run_;
  std::vector<std::pair<std::string, std::unique_ptr<RasterOfRows>>> files_;
};

}  // namespace

void write_surface_rasters(const RasterFrame& frame, const std::filesystem::path& folder) {
  SurfaceRasters(frame, folder).write();
}

std::uint64_t surface_rasters_bytes(const RasterFrame& frame) {
  RasterFrame one = frame;
  one.bands.resize(1);
  constexpr std::uint64_t rasters_of_strip = 8;
  const std::uint64_t rows = raster_tile_edge + 2 * (aspect_reach(frame.step_m) + 1);
  return geotiff_bytes(one) + rasters_of_strip * rows * frame.columns * sizeof(float);
}

}  // namespace farlod
