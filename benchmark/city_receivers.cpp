// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/city_receivers.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "benchmark/measurement.hpp"
#include "evaluate/verification.hpp"
#include "receivers/raster_receivers.hpp"
#include "receivers/surface_receivers.hpp"

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

}  // namespace farlod::benchmark
