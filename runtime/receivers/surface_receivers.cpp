// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/surface_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace farlod {
namespace {

bool is_chosen(SurfaceKind kind, SurfaceChoice choice) {
  if (kind == SurfaceKind::roof) return choice != SurfaceChoice::walls;
  return kind == SurfaceKind::wall && choice != SurfaceChoice::roofs;
}

/// The n-th point of the R2 sequence (M. Roberts 2018), folded from the unit square into the triangle of barycentric
/// coordinates (u, v) with u + v ≤ 1. The fold keeps areas.
Point2d in_triangle(std::size_t n) {
  constexpr double plastic = 1.32471795724474602596;
  const auto fraction = [](double x) { return x - std::floor(x); };
  const double u = fraction(0.5 + static_cast<double>(n + 1) / plastic);
  const double v = fraction(0.5 + static_cast<double>(n + 1) / (plastic * plastic));
  return u + v <= 1.0 ? Point2d{u, v} : Point2d{1.0 - u, 1.0 - v};
}

/// One receiver stands in the middle; more are spread.
Point2d place_in_triangle(std::size_t n, std::size_t count) {
  return count == 1 ? Point2d{1.0 / 3.0, 1.0 / 3.0} : in_triangle(n);
}

/// Columns of a cell and of its neighbours: a receiver that stands off a wall on the cell's border is in the next.
class ColumnsAround {
 public:
  ColumnsAround(const Package& package, Cell cell) : package_(package), cell_(cell) {}

  [[nodiscard]] bool is_buried(const Point3f& p_cell) {
    const Grid& grid = package_.grid();
    const auto edge_m = static_cast<float>(grid.cell_edge_m);
    const auto step = [edge_m](float x) { return x < 0.0F ? -1 : x >= edge_m ? 1 : 0; };
    const Cell there{cell_.i + step(p_cell.x), cell_.j + step(p_cell.y)};
    if (!grid.cells.contains(there)) return false;
    const CellColumns& columns = columns_.try_emplace(there, package_, there).first->second;
    const Point2d p = Point2d{p_cell.x, p_cell.y} + grid.corner_of(cell_) - grid.corner_of(there);
    return columns.at(static_cast<float>(p.x), static_cast<float>(p.y)).is_buried(p_cell.z);
  }

 private:
  const Package& package_;
  Cell cell_;
  std::map<Cell, CellColumns> columns_;
};

void spread(const TileView& tile, std::uint32_t t, double spacing_m, ColumnsAround& columns,
            std::vector<SurfaceReceiver>& receivers) {
  const Triangle& corners = tile.mesh.triangles[t];
  const Point3f a = tile.mesh.vertices[corners.a];
  const Point3f ab = tile.mesh.vertices[corners.b] - a, ac = tile.mesh.vertices[corners.c] - a;
  const float area_m2 = 0.5F * norm(cross(ab, ac));
  if (area_m2 == 0.0F) return;  // rounded away: it holds no share of the surface
  const Point3f normal = tile.surface_of(t).normal().direction();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(static_cast<double>(area_m2) / (spacing_m * spacing_m))));
  for (std::size_t n = 0; n < count; ++n) {
    const Point2d w = place_in_triangle(n, count);
    const Point3f p = a + static_cast<float>(w.x) * ab + static_cast<float>(w.y) * ac + surface_offset_m * normal;
    receivers.push_back({t, area_m2 / static_cast<float>(count), p, normal, columns.is_buried(p)});
  }
}

}  // namespace

std::vector<SurfaceReceiver> surface_receivers(const Package& package, Cell cell, SurfaceChoice choice, double spacing_m) {
  const TileView tile = package.tile(cell);
  ColumnsAround columns(package, cell);
  std::vector<SurfaceReceiver> receivers;
  for (std::uint32_t t = 0; t < tile.mesh.triangles.size(); ++t)
    if (is_chosen(tile.surface_of(t).kind, choice)) spread(tile, t, spacing_m, columns, receivers);
  return receivers;
}

}  // namespace farlod
