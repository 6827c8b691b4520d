// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/run_settings.hpp"
#include "farlod/error.hpp"
#include "farlod/morphology.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"
#include "run/surface_averages.hpp"

namespace farlod {
namespace {

/// Collects the receivers of each cell, which come in the same order whatever the number of threads. The manifest must outlive
/// it.
class SkyOfCells {
 public:
  explicit SkyOfCells(const package::Manifest& manifest)
      : manifest_(manifest), sums_(static_cast<std::size_t>(manifest.grid.cells.size())) {}

  void add(const RasterPlan& plan, const RasterTile& tile) {
    const std::size_t rows = pixels_of_tile(tile.place.row, plan.rows), columns = pixels_of_tile(tile.place.column, plan.columns);
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) {
        const float svf = tile.svf[row * raster_tile_edge + column];
        if (std::isnan(svf)) continue;
        const Point2d centre =
            plan.centre_m(tile.place.column * raster_tile_edge + column, tile.place.row * raster_tile_edge + row);
        const Cell cell = manifest_.grid.cell_of(manifest_.grid_from_projected(centre));
        if (manifest_.grid.cells.contains(cell))
          sums_[manifest_.grid.cells.index_of(cell)].ground.add(double{svf}, plan.step_m * plan.step_m);
      }
  }
  void add(std::size_t cell, std::span<const SurfacePoint> points) {
    for (const SurfacePoint& point : points) {
      if (!point.svf) continue;
      if (point.kind == SurfaceKind::wall) sums_[cell].walls.add(*point.svf, point.area_m2);
      if (point.kind == SurfaceKind::roof) sums_[cell].roofs.add(*point.svf, point.area_m2);
    }
  }
  [[nodiscard]] std::vector<CellSky> means() const {
    std::vector<CellSky> result;
    for (const Sums& s : sums_) result.push_back({s.ground.value(), s.walls.value(), s.roofs.value()});
    return result;
  }

 private:
  struct Sums {
    AreaMean ground, walls, roofs;
  };
  const package::Manifest& manifest_;
  std::vector<Sums> sums_;
};

}  // namespace

std::vector<CellSky> sky_of_cells(const Package& package, double spacing_m, const EvaluationSettings& settings,
                                  const RunSettings& run) {
  require_between("spacing_m", spacing_m, 0.05, 1000.0);
  if (settings.dry_run) throw InvalidArgument("a dry run has no means: leave dry_run out");
  if (run.answers || run.shard) throw InvalidArgument("the means of cells are not kept: leave answers and shard out");
  const PackageInUse in_use(package);
  const package::Manifest& manifest = in_use.reader().manifest();
  SkyOfCells cells(manifest);
  const auto count = static_cast<double>(manifest.grid.cells.size());
  const RunSettings with_means =
      with_bytes_of_caller(run, static_cast<std::uint64_t>(count * (6.0 * sizeof(double) + sizeof(CellSky))));
  const RasterPlan plan = plan_raster(package, spacing_m, package.description().outline_projected);
  (void)evaluate_raster(
      package, plan, {.above = HeightAbove::ground, .height_m = 0.0}, settings,
      [&](const RasterTile& tile) { cells.add(plan, tile); }, with_means);
  (void)evaluate_surfaces(
      package, {.choice = SurfaceChoice::all, .spacing_m = spacing_m}, settings,
      [&](std::size_t cell, std::span<const SurfacePoint> points) { cells.add(cell, points); }, with_means);
  return cells.means();
}

}  // namespace farlod
