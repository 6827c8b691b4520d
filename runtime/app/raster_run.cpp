// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <utility>

#include "app/evaluation.hpp"
#include "receivers/raster_receivers.hpp"
#include "results/raster_preview.hpp"
#include "results/raster_writer_esri_ascii.hpp"
#include "results/sky_raster.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/esri_wkt_gdal.hpp"
#include "results/raster_writer_gdal.hpp"
#endif

namespace farlod {
namespace {

/// GIS programs read the `.prj` beside an ASCII grid only in Esri's dialect; without GDAL it stays as the package has it.
SkyRaster with_esri_wkt(SkyRaster raster) {
#ifdef FARLOD_WITH_GDAL
  raster.crs_wkt = esri_wkt_of(raster.crs_wkt);
#endif
  return raster;
}

void write_raster(const SkyRaster& raster, const SvfOptions& options) {
  switch (options.format) {
    case OutputFormat::png:
      return write_png_preview(raster, options.output);
    case OutputFormat::esri_ascii:
      return write_esri_ascii(with_esri_wkt(raster), options.output);
    case OutputFormat::geotiff:
#ifdef FARLOD_WITH_GDAL
      return write_geotiff(raster, options.output);
#endif
    case OutputFormat::csv:
      break;
  }
  FARLOD_EXPECTS(!"the options allow only formats that this build writes");
}

}  // namespace

SvfRun run_raster(const Package& package, const SvfOptions& options) {
  const RasterPlan plan = plan_raster(package.manifest(), options.grid_step_m, options.bbox_projected);
  SkyRaster raster{plan.north_west_m,         plan.step_m, plan.columns, plan.rows, {}, {}, {}, quantity_name(options.sky.weight),
                   package.manifest().crs_wkt};
  AnswerTable answers(plan.columns * plan.rows, options.bounds);
  const RasterReceivers receivers(package.manifest(), plan);
  const std::vector<Cell> cells = receivers.cells();
  SvfRun run;
  const auto receivers_of = [&](std::size_t n) {
    return receivers.in_cell(package, cells[n], options.height_above, static_cast<float>(options.height_m));
  };
  evaluate_cells(package, options, cells.size(), receivers_of, answers, run);
  raster.svf = std::move(answers.svf);
  raster.low = std::move(answers.low);
  raster.high = std::move(answers.high);
  run.beyond_grid = raster.svf.size() - receivers.pixels_in_grid(cells);
  run.inside_buildings = raster.svf.size() - run.beyond_grid - run.receivers;
  const auto start = std::chrono::steady_clock::now();
  write_raster(raster, options);
  run.files.push_back(options.output);
  if (!options.preview_file.empty()) {
    write_png_preview(raster, options.preview_file);
    run.files.emplace_back(options.preview_file);
  }
  run.seconds.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace farlod
