// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/height_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace farlod::benchmark {
namespace {

/// A corner of a triangle: pixel centres are at whole columns and rows.
struct PixelCorner {
  double column = 0.0, row = 0.0, z_m = 0.0;
};
using PixelTriangle = std::array<PixelCorner, 3>;

double doubled_area(const PixelCorner& a, const PixelCorner& b, double column, double row) {
  return (b.column - a.column) * (row - a.row) - (b.row - a.row) * (column - a.column);
}

class Rasteriser {
 public:
  Rasteriser(const package::Manifest& manifest, HeightRaster& raster) : manifest_(manifest), raster_(raster) {}

  void draw(const TileView& tile, Point2d corner_grid) {
    for (std::uint32_t t = 0; t < tile.mesh.triangles.size(); ++t) {
      const Triangle& triangle = tile.mesh.triangles[t];
      const auto corner = [&](std::uint32_t vertex) { return pixel_corner(tile.mesh.vertices[vertex], corner_grid); };
      const bool is_ground = tile.surface_of(t).kind() == SurfaceKind::ground;
      fill({corner(triangle.a), corner(triangle.b), corner(triangle.c)}, is_ground ? raster_.ground_m : raster_.surface_m);
    }
  }

 private:
  [[nodiscard]] PixelCorner pixel_corner(const Point3f& p_cell, Point2d corner_grid) const {
    const Point3d p = manifest_.projected_from_grid({corner_grid.x + p_cell.x, corner_grid.y + p_cell.y, p_cell.z});
    const RasterPlan& plan = raster_.plan;
    return {(p.x - plan.north_west_m.x) / plan.step_m - 0.5, (plan.north_west_m.y - p.y) / plan.step_m - 0.5, p.z};
  }

  /// Raises the pixels whose centres the triangle covers, borders included. A vertical one covers none.
  void fill(const PixelTriangle& t, std::vector<float>& heights_m) const {
    const double area = doubled_area(t[0], t[1], t[2].column, t[2].row);
    if (area == 0.0) return;
    const auto [left, right] = std::minmax({t[0].column, t[1].column, t[2].column});
    const auto [top, bottom] = std::minmax({t[0].row, t[1].row, t[2].row});
    for (std::size_t row = first_from(top); row < end_after(bottom, raster_.plan.rows); ++row)
      for (std::size_t column = first_from(left); column < end_after(right, raster_.plan.columns); ++column) {
        const auto x = static_cast<double>(column), y = static_cast<double>(row);
        const double a = doubled_area(t[1], t[2], x, y) / area, b = doubled_area(t[2], t[0], x, y) / area;
        if (a < 0.0 || b < 0.0 || a + b > 1.0) continue;
        float& height_m = heights_m[row * raster_.plan.columns + column];
        height_m = std::max(height_m, static_cast<float>(a * t[0].z_m + b * t[1].z_m + (1.0 - a - b) * t[2].z_m));
      }
  }
  static std::size_t first_from(double place) { return static_cast<std::size_t>(std::max(0.0, std::ceil(place))); }
  static std::size_t end_after(double place, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(std::floor(place) + 1.0, 0.0, static_cast<double>(size)));
  }

  const package::Manifest& manifest_;
  HeightRaster& raster_;
};

}  // namespace

HeightRaster rasterise(const PackageReader& package, double pixel_m) {
  HeightRaster raster{plan_raster(package.manifest(), pixel_m, std::nullopt), {}, {}};
  const std::size_t pixels = raster.plan.columns * raster.plan.rows;
  raster.surface_m.assign(pixels, -std::numeric_limits<float>::infinity());
  raster.ground_m = raster.surface_m;
  Rasteriser rasteriser(package.manifest(), raster);
  const Grid& grid = package.grid();
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n)
    rasteriser.draw(package.tile(grid.cells.cell_at(n)), grid.corner_of(grid.cells.cell_at(n)));
  for (std::size_t n = 0; n < pixels; ++n) raster.surface_m[n] = std::max(raster.surface_m[n], raster.ground_m[n]);
  return raster;
}

}  // namespace farlod::benchmark
