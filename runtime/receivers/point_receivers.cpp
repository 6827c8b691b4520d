// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/point_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "base/cancellation.hpp"

namespace farlod {
namespace {

struct CellHash {
  /// Odd numbers without a pattern (the golden ratio's and another), so that rows of cells do not share their buckets.
  std::size_t operator()(const Cell& c) const {
    constexpr std::uint64_t of_column = 0x9E3779B97F4A7C15ULL, of_row = 0xC2B2AE3D27D4EB4FULL;
    return (static_cast<std::uint64_t>(c.i) * of_column) ^ (static_cast<std::uint64_t>(c.j) * of_row);
  }
};

Cell nearest_existing(Cell c, const CellRange& cells) {
  return {std::clamp(c.i, cells.i_begin, cells.i_end - 1), std::clamp(c.j, cells.j_begin, cells.j_end - 1)};
}

/// A point of the grid frame in the frame of a cell, moved into the cell's square when it lies outside.
Point2d cell_point_within(Point2d p_grid, Cell cell, const Grid& grid) {
  const Point2d p = p_grid - grid.corner_of(cell);
  // The square is closed at its west and south only
  const double last_m = std::nextafter(static_cast<float>(grid.cell_edge_m), 0.0F);
  return {std::clamp(p.x, 0.0, last_m), std::clamp(p.y, 0.0, last_m)};
}

/// For a point outside of the grid: the ground is that at the border of the grid. There are no buildings, even where one ends at
/// the border.
std::optional<Point3f> stand_outside(const PointLocator& locator, Point2d p_cell, Point2d at_border, HeightAbove above,
                                     float height_m) {
  const VerticalProfile profile = locator.at(static_cast<float>(at_border.x), static_cast<float>(at_border.y));
  const auto z_m = standing_height_m(profile, above == HeightAbove::highest_surface ? HeightAbove::ground : above, height_m);
  if (!z_m) return std::nullopt;
  return Point3f{static_cast<float>(p_cell.x), static_cast<float>(p_cell.y), *z_m};
}

}  // namespace

std::vector<std::pair<Cell, std::vector<std::size_t>>> places_by_cell(const PackageReader& package,
                                                                      std::span<const PlaceOfReceiver> places) {
  std::vector<std::pair<Cell, std::vector<std::size_t>>> cells;
  std::unordered_map<Cell, std::size_t, CellHash> numbers;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Cell cell = package.grid().cell_of(package.manifest().grid_from_projected(places[n].p_projected));
    const auto [found, is_new] = numbers.try_emplace(cell, cells.size());
    if (is_new) cells.emplace_back(cell, std::vector<std::size_t>());
    cells[found->second].second.push_back(n);
  }
  std::ranges::sort(cells, {}, [](const auto& places_of_cell) { return places_of_cell.first; });
  return cells;
}

CellReceivers receivers_at(const PackageReader& package, Cell cell, std::span<const PlaceOfReceiver> places,
                           std::span<const std::size_t> chosen, HeightAbove above, float height_m, const std::stop_token& stop) {
  const Grid& grid = package.grid();
  const Cell existing = nearest_existing(cell, grid.cells);
  const PointLocator locator(package, existing);
  CellReceivers result{cell, {}};
  for (const std::size_t n : chosen) {
    throw_if_cancelled(stop);
    const Point2d p_grid = package.manifest().grid_from_projected(places[n].p_projected);
    const Point2d p_cell = p_grid - grid.corner_of(cell);
    const auto x = static_cast<float>(p_cell.x), y = static_cast<float>(p_cell.y);
    const bool has_height = places[n].height_m.has_value();
    const HeightAbove from = has_height ? HeightAbove::sea_level : above;
    const float height = has_height ? static_cast<float>(*places[n].height_m - package.manifest().height_origin_m) : height_m;
    const auto standing = cell == existing
                              ? stand(locator, x, y, from, height)
                              : stand_outside(locator, {x, y}, cell_point_within(p_grid, existing, grid), from, height);
    if (standing) result.receivers.push_back({n, *standing, places[n].normal_grid});
  }
  return result;
}

}  // namespace farlod
