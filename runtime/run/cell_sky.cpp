// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/run_settings.hpp"
#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "farlod/morphology.hpp"
#include "farlod/raster.hpp"
#include "farlod/region.hpp"
#include "farlod/surfaces.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"
#include "run/surface_averages.hpp"
#include "run/zones_of_grid.hpp"

namespace farlod {
namespace {

/// What receivers of one place add up to.
struct SkySums {
  AreaMean ground, walls, roofs;

  [[nodiscard]] CellSky means() const { return {ground.value(), walls.value(), roofs.value()}; }
};

std::vector<CellSky> means_of(const std::vector<SkySums>& sums) {
  std::vector<CellSky> result;
  for (const SkySums& s : sums) result.push_back(s.means());
  return result;
}

void add(const SurfacePoint& point, SkySums& sums) {
  if (!point.svf) return;
  if (point.kind == SurfaceKind::wall) sums.walls.add(*point.svf, point.area_m2);
  if (point.kind == SurfaceKind::roof) sums.roofs.add(*point.svf, point.area_m2);
}

/// Calls `f(centre, svf)` for each pixel of a tile that has a value.
template <class F>
void visit_pixels(const RasterPlan& plan, const RasterTile& tile, const F& f) {
  const std::size_t rows = pixels_of_tile(tile.place.row, plan.rows), columns = pixels_of_tile(tile.place.column, plan.columns);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const float svf = tile.svf[row * raster_tile_edge + column];
      if (!std::isnan(svf))
        f(plan.centre_m(tile.place.column * raster_tile_edge + column, tile.place.row * raster_tile_edge + row), double{svf});
    }
}

void require_means(double spacing_m, const EvaluationSettings& settings, const RunSettings& run) {
  require_between("spacing_m", spacing_m, 0.05, 1000.0);
  if (settings.dry_run) throw InvalidArgument("a dry run has no means: leave dry_run out");
  if (run.answers || run.shard) throw InvalidArgument("means are not kept: leave answers and shard out");
}

/// Evaluates the ground of a part of the map, and all surfaces. Receivers come in the same order for any number of threads:
/// `on_pixel(centre, svf)`, then `on_point(cell, point)`.
template <class OnPixel, class OnPoint>
void evaluate_all(const Package& package, const Box2d& part, double spacing_m, const EvaluationSettings& settings,
                  const RunSettings& run, const OnPixel& on_pixel, const OnPoint& on_point) {
  const RasterPlan plan = plan_raster(package, spacing_m, part);
  (void)evaluate_raster(
      package, plan, {.above = HeightAbove::ground, .height_m = 0.0}, settings,
      [&](const RasterTile& tile) { visit_pixels(plan, tile, on_pixel); }, run);
  (void)evaluate_surfaces(
      package, {.choice = SurfaceChoice::all, .spacing_m = spacing_m}, settings,
      [&](std::size_t cell, std::span<const SurfacePoint> points) {
        for (const SurfacePoint& point : points) on_point(cell, point);
      },
      run);
}

std::uint64_t bytes_of_means(std::size_t count) { return count * (sizeof(SkySums) + sizeof(CellSky)); }

/// Behind a wall, where its building is: receivers stand 1 cm in front of it.
Point2d behind(const SurfacePoint& point, Angle convergence) {
  constexpr double depth_m = 0.02;
  const Point2d p{point.p_projected.x, point.p_projected.y};
  if (point.kind != SurfaceKind::wall) return p;
  const Angle azimuth = point.azimuth - convergence;
  return p - depth_m * Point2d{sin(azimuth), cos(azimuth)};
}

}  // namespace

std::vector<CellSky> sky_of_cells(const Package& package, double spacing_m, const EvaluationSettings& settings,
                                  const RunSettings& run) {
  require_means(spacing_m, settings, run);
  const PackageInUse in_use(package);
  const package::Manifest& manifest = in_use.reader().manifest();
  const Grid& grid = manifest.grid;
  std::vector<SkySums> sums(static_cast<std::size_t>(grid.cells.size()));
  evaluate_all(
      package, package.description().outline_projected, spacing_m, settings,
      with_bytes_of_caller(run, bytes_of_means(sums.size())),
      [&](Point2d centre, double svf) {
        const Cell cell = grid.cell_of(manifest.grid_from_projected(centre));
        if (grid.cells.contains(cell)) sums[grid.cells.index_of(cell)].ground.add(svf, spacing_m * spacing_m);
      },
      [&](std::size_t cell, const SurfacePoint& point) { add(point, sums[cell]); });
  return means_of(sums);
}

std::vector<CellSky> sky_of_zones(const Package& package, const std::vector<Zone>& zones, double spacing_m,
                                  const EvaluationSettings& settings, const RunSettings& run) {
  require_means(spacing_m, settings, run);
  if (settings.region) throw InvalidArgument("zones say what is evaluated: leave region out");
  const PackageInUse in_use(package);
  const package::Manifest& manifest = in_use.reader().manifest();
  const ZonesOfGrid places(manifest, zones);
  std::vector<SkySums> sums(zones.size());
  if (zones.empty()) return {};
  // Walls may stand off the cells that they belong to
  constexpr double margin_m = 1.0;
  const Box2d near = grown(places.outline_projected(), margin_m);
  EvaluationSettings of_zones = settings;
  of_zones.region = std::make_shared<const Region>(
      std::vector<Region::Ring>{{near.low, {near.high.x, near.low.y}, near.high, {near.low.x, near.high.y}}});
  evaluate_all(
      package, near, spacing_m, of_zones, with_bytes_of_caller(run, bytes_of_means(sums.size())),
      [&](Point2d centre, double svf) {
        places.visit(manifest.grid_from_projected(centre),
                     [&](std::size_t zone) { sums[zone].ground.add(svf, spacing_m * spacing_m); });
      },
      [&](std::size_t, const SurfacePoint& point) {
        places.visit(manifest.grid_from_projected(behind(point, manifest.convergence)),
                     [&](std::size_t zone) { add(point, sums[zone]); });
      });
  return means_of(sums);
}

}  // namespace farlod
