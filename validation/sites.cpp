// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/sites.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <random>

#include "evaluate/verification.hpp"

namespace farlod::validation {
namespace {

/// Dense enough that most surfaces have a choice of places.
constexpr double surface_spacing_m = 6.0;
constexpr float head_m = 1.5F;

Site site_of(const PackageReader& package, Cell cell, const Point3f& p_cell, const Point3f& normal_grid) {
  const Grid& grid = package.grid();
  const Point2d corner = grid.corner_of(cell);
  const Point3d p_grid{corner.x + p_cell.x, corner.y + p_cell.y, p_cell.z + package.manifest().height_origin_m};
  return {grid.rotation.city_from_grid(p_grid),
          grid.rotation.city_from_grid(Point3d{normal_grid.x, normal_grid.y, normal_grid.z})};
}

Receiver receiver_of(const PackageReader& package, Cell cell, const Site& site, std::size_t index) {
  const Grid& grid = package.grid();
  const Point3d p = grid.rotation.grid_from_city(site.p_city), n = grid.rotation.grid_from_city(site.normal_city);
  const Point2d corner = grid.corner_of(cell);
  return {index,
          {static_cast<float>(p.x - corner.x), static_cast<float>(p.y - corner.y),
           static_cast<float>(p.z - package.manifest().height_origin_m)},
          {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}};
}

Cell cell_of(const Grid& grid, const Site& site) { return grid.cell_of(grid.rotation.grid_from_city(horizontal(site.p_city))); }

std::vector<CellReceivers> receivers_of(const PackageReader& package, std::span<const Site> sites) {
  std::map<Cell, std::vector<Receiver>> by_cell;
  for (std::size_t n = 0; n < sites.size(); ++n) {
    const Cell cell = cell_of(package.grid(), sites[n]);
    by_cell[cell].push_back(receiver_of(package, cell, sites[n], n));
  }
  std::vector<CellReceivers> result;
  for (auto& [cell, receivers] : by_cell) result.push_back({cell, std::move(receivers)});
  return result;
}

}  // namespace

std::vector<Site> ground_sites(const PackageReader& package, std::span<const Cell> cells, std::size_t count) {
  std::mt19937_64 random(20120901);
  const auto uniform = [&random](double end) { return end * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::map<Cell, PointLocator> columns;
  std::vector<Site> sites;
  while (sites.size() < count) {
    const Cell cell = cells[static_cast<std::size_t>(uniform(static_cast<double>(cells.size())))];
    const double edge_m = package.grid().cell_edge_m;
    const auto x = static_cast<float>(uniform(edge_m)), y = static_cast<float>(uniform(edge_m));
    const PointLocator& here = columns.try_emplace(cell, package, cell).first->second;
    const auto p_cell = stand(here, x, y, HeightAbove::ground, head_m);
    if (p_cell) sites.push_back(site_of(package, cell, *p_cell, {0.0F, 0.0F, 1.0F}));
  }
  return sites;
}

std::vector<Site> surface_sites(const PackageReader& package, std::span<const Cell> cells, SurfaceChoice choice,
                                std::size_t count) {
  std::vector<std::vector<Site>> by_cell(cells.size());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
    for (const SurfaceReceiver& r : surface_receivers(package, cells[n], choice, surface_spacing_m))
      if (!r.is_inside_building) by_cell[n].push_back(site_of(package, cells[n], r.p_cell, r.normal));
  });
  std::vector<Site> all, chosen;
  for (const std::vector<Site>& some : by_cell) all.insert(all.end(), some.begin(), some.end());
  for (const std::size_t n : choose_some(all.size(), count)) chosen.push_back(all[n]);
  return chosen;
}

std::vector<Cell> all_cells(const Grid& grid) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) cells.push_back(grid.cells.cell_at(n));
  return cells;
}

std::vector<Cell> cells_of(const Grid& grid, std::span<const Site> sites) {
  std::vector<Cell> cells;
  for (const Site& site : sites) cells.push_back(cell_of(grid, site));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

SkyFigures sky_at(const PackageReader& package, const SkySettings& settings, std::span<const Site> sites) {
  const SkyEvaluator evaluator(package, settings);
  const std::vector<CellReceivers> receivers = receivers_of(package, sites);
  std::vector<float> svf(sites.size()), low(svf), high(svf);
  oneapi::tbb::parallel_for(std::size_t{0}, receivers.size(),
                            [&](std::size_t n) { evaluator.evaluate(receivers[n], SkyAnswers(svf, low, high)); });
  return {{svf.begin(), svf.end()}, {low.begin(), low.end()}, {high.begin(), high.end()}};
}

BoundsSummary summarize_bounds(const SkyFigures& figures, std::span<const double> exact, std::size_t rays) {
  BoundsSummary summary;
  // A ray that grazes an edge may go either way: coordinates are floats
  const double grazing = 1.5 / static_cast<double>(rays);
  for (std::size_t n = 0; n < exact.size(); ++n) {
    const double width = figures.high[n] - figures.low[n];
    summary.mean_width += width / static_cast<double>(exact.size());
    summary.max_width = std::max(summary.max_width, width);
    if (exact[n] < figures.low[n] - grazing || exact[n] > figures.high[n] + grazing) ++summary.outside;
  }
  return summary;
}

}  // namespace farlod::validation
