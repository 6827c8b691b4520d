// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/whole_city_rival.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "benchmark/contest.hpp"
#include "evaluate/verification.hpp"
#include "receivers/point_receivers.hpp"
#include "receivers/raster_receivers.hpp"

namespace farlod::benchmark {
namespace {

constexpr float head_m = 1.5F;

CellReceivers on_surfaces(const PackageReader& package, Cell cell, SurfaceChoice choice, double spacing_m) {
  CellReceivers result{cell, {}};
  for (const SurfaceReceiver& r : surface_receivers(package, cell, choice, spacing_m))
    if (!r.is_inside_building) result.receivers.push_back({0, r.p_cell, r.normal});
  return result;
}

void renumber(CityReceivers& city) {
  city.count = 0;
  for (CellReceivers& cell : city.cells)
    for (Receiver& r : cell.receivers) r.index = city.count++;
}

}  // namespace

const char* name_of(Place place) { return place == Place::ground ? "ground" : place == Place::roofs ? "roofs" : "façades"; }

std::vector<Cell> spread_cells(const Grid& grid, std::size_t count) {
  const auto all = static_cast<std::size_t>(grid.cells.size());
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < std::min(count, all); ++n)
    cells.push_back(grid.cells.cell_at((2 * n + 1) * all / (2 * std::min(count, all))));
  return cells;
}

CityReceivers place_receivers(const PackageReader& package, std::span<const Cell> cells, Place place, double spacing_m) {
  const RasterReceivers raster(package.manifest(), plan_raster(package.manifest(), spacing_m, std::nullopt));
  CityReceivers city;
  city.cells.resize(cells.size());
  city.placing_s = seconds_of([&] {
    oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
      city.cells[n] =
          place == Place::ground
              ? raster.in_cell(package, cells[n], HeightAbove::ground, head_m)
              : on_surfaces(package, cells[n], place == Place::roofs ? SurfaceChoice::roofs : SurfaceChoice::walls, spacing_m);
    });
  });
  renumber(city);
  return city;
}

CityReceivers choose_receivers(const CityReceivers& all, std::size_t count) {
  CityReceivers chosen;
  std::size_t cell = 0;
  for (const std::size_t n : choose_some(all.count, count)) {
    while (all.cells[cell].receivers.empty() || all.cells[cell].receivers.back().index < n) ++cell;
    if (chosen.cells.empty() || chosen.cells.back().cell != all.cells[cell].cell)
      chosen.cells.push_back({all.cells[cell].cell, {}});
    chosen.cells.back().receivers.push_back(all.cells[cell].receivers[n - all.cells[cell].receivers.front().index]);
  }
  renumber(chosen);
  return chosen;
}

CityTriangles triangles_of(const PackageReader& package) {
  const Grid& grid = package.grid();
  CityTriangles city;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    const MeshView mesh = package.tile(cell).mesh;
    const Point2d shift_m = grid.corner_of(cell) - grid.middle_corner();
    const auto first = static_cast<std::uint32_t>(city.vertices.size());
    for (const Point3f& p : mesh.vertices)
      city.vertices.push_back({static_cast<float>(p.x + shift_m.x), static_cast<float>(p.y + shift_m.y), p.z});
    for (const Triangle& t : mesh.triangles) city.triangles.push_back({t.a + first, t.b + first, t.c + first});
  }
  // Embree reads the last vertex as 16 bytes
  city.vertices.push_back({});
  return city;
}

namespace {

constexpr std::uint32_t squares_per_edge = 1U << 16;

std::uint32_t square_along(double x) {
  return static_cast<std::uint32_t>(std::clamp(x * squares_per_edge, 0.0, squares_per_edge - 1.0));
}

}  // namespace

std::uint64_t place_on_curve(double x, double y) {
  std::uint32_t column = square_along(x), row = square_along(y);
  std::uint64_t place = 0;
  for (std::uint32_t edge = squares_per_edge / 2; edge > 0; edge /= 2) {
    const std::uint32_t right = (column & edge) != 0 ? 1 : 0, upper = (row & edge) != 0 ? 1 : 0;
    place += std::uint64_t{edge} * edge * ((3 * right) ^ upper);
    // Turn the quarter so that the curve through it begins where the one before ended
    if (upper == 0) {
      if (right == 1) {
        column = squares_per_edge - 1 - column;
        row = squares_per_edge - 1 - row;
      }
      std::swap(column, row);
    }
  }
  return place;
}

}  // namespace farlod::benchmark
