// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/point_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/cancellation.hpp"
#include "farlod/error.hpp"
#include "package/horizon_edge.hpp"
#include "scene/far_ground.hpp"

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

/// The profile of a point outside of the grid: the ground is the far terrain, or else that at the border of the grid.
VerticalProfile profile_outside(const FarGround& far_ground, const PointLocator& locator, Point2d p_cell, Point2d at_border) {
  constexpr bool looks_up = true;
  if (const auto height_m = far_ground.height_at(static_cast<float>(p_cell.x), static_cast<float>(p_cell.y)))
    return VerticalProfile({{*height_m, package::no_building, 0, looks_up}});
  return locator.at(static_cast<float>(at_border.x), static_cast<float>(at_border.y));
}

/// For a point outside of the grid, there are no buildings, even where one ends at the border.
std::optional<Point3f> stand_outside(const VerticalProfile& profile, Point2d p_cell, HeightAbove above, float height_m) {
  const auto z_m = standing_height_m(profile, above == HeightAbove::highest_surface ? HeightAbove::ground : above, height_m);
  if (!z_m) return std::nullopt;
  return Point3f{static_cast<float>(p_cell.x), static_cast<float>(p_cell.y), *z_m};
}

/// What the height of a place counts from, and how much it is.
std::pair<HeightAbove, float> height_of_place(const PlaceOfReceiver& place, HeightAbove above, float height_m, double origin_m) {
  if (place.height_m) return {HeightAbove::sea_level, static_cast<float>(*place.height_m - origin_m)};
  if (place.above_ground_m) return {HeightAbove::ground, std::max(static_cast<float>(*place.above_ground_m), surface_offset_m)};
  return {above, height_m};
}

/// 3 GiB. Areas are what a package says, and what is asked for is of its user: one of the two is not meant.
constexpr double most_receivers_of_cell = 67'108'864.0;

void require_room_for(double count, std::size_t placed, Cell cell) {
  if (static_cast<double>(placed) + count <= most_receivers_of_cell) return;
  throw LimitReached("the surfaces of cell (" + std::to_string(cell.i) + ", " + std::to_string(cell.j) +
                     ") would have more than " + std::to_string(static_cast<std::size_t>(most_receivers_of_cell)) +
                     " receivers: place them farther from each other, or pack the city in smaller cells.");
}

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

/// A single receiver stands in the middle.
Point2d place_in_triangle(std::size_t n, std::size_t count) {
  return count == 1 ? Point2d{1.0 / 3.0, 1.0 / 3.0} : in_triangle(n);
}

/// Locators of a cell and of its neighbors: a receiver that stands off a wall on the border of the cell lies in the next cell.
class LocatorsAround {
 public:
  LocatorsAround(const PackageReader& package, Cell cell) : package_(package), cell_(cell) {}

  [[nodiscard]] Cell cell() const { return cell_; }
  [[nodiscard]] bool is_buried(const Point3f& p_cell) {
    const Grid& grid = package_.grid();
    const auto edge_m = static_cast<float>(grid.cell_edge_m);
    const auto step = [edge_m](float x) { return x < 0.0F ? -1 : x >= edge_m ? 1 : 0; };
    const Cell there{cell_.i + step(p_cell.x), cell_.j + step(p_cell.y)};
    if (!grid.cells.contains(there)) return false;
    const PointLocator& locator = locators_.try_emplace(there, package_, there).first->second;
    const Point2d p = Point2d{p_cell.x, p_cell.y} + grid.corner_of(cell_) - grid.corner_of(there);
    return locator.at(static_cast<float>(p.x), static_cast<float>(p.y)).is_buried(p_cell.z);
  }

 private:
  const PackageReader& package_;
  Cell cell_;
  std::map<Cell, PointLocator> locators_;
};

/// Triangles of one surface in a tile.
struct Piece {
  std::uint32_t begin = 0, end = 0;
  Point3f normal;
  float top_m = -std::numeric_limits<float>::infinity();
};

Piece piece_of(const TileView& tile, std::uint32_t begin, const package::SurfaceRun& run) {
  Piece piece{begin, run.end, tile.surfaces[run.surface].normal().direction()};
  for (std::uint32_t t = begin; t < run.end; ++t) {
    const Triangle& corners = tile.mesh.triangles[t];
    for (const std::uint32_t v : {corners.a, corners.b, corners.c}) piece.top_m = std::max(piece.top_m, tile.mesh.vertices[v].z);
  }
  return piece;
}

/// Horizontal distance by which the top of a wall that leans out lies ahead of a point of the wall at height z_m. 0 where it is
/// more than max_lean_m: such a wall overhangs the receiver.
float lean_ahead_m(const Piece& wall, float z_m) {
  if (wall.normal.z >= 0.0F) return 0.0F;
  const float ahead_m = (wall.top_m - z_m) * -wall.normal.z / std::hypot(wall.normal.x, wall.normal.y);
  return ahead_m <= static_cast<float>(max_lean_m) ? ahead_m : 0.0F;
}

void spread(const TileView& tile, const Piece& piece, std::uint32_t t, double spacing_m, LocatorsAround& locators,
            const std::stop_token& stop, std::vector<SurfaceReceiver>& receivers) {
  const Triangle& corners = tile.mesh.triangles[t];
  const Point3f a = tile.mesh.vertices[corners.a];
  const Point3f ab = tile.mesh.vertices[corners.b] - a, ac = tile.mesh.vertices[corners.c] - a;
  const float area_m2 = 0.5F * norm(cross(ab, ac));
  if (area_m2 == 0.0F) return;  // rounded to nothing: it has no area to stand for
  const double wanted = std::max(1.0, std::ceil(static_cast<double>(area_m2) / (spacing_m * spacing_m)));
  require_room_for(wanted, receivers.size(), locators.cell());
  const auto count = static_cast<std::size_t>(wanted);
  for (std::size_t n = 0; n < count; ++n) {
    throw_if_cancelled(stop);
    const Point2d w = place_in_triangle(n, count);
    const Point3f on_surface = a + static_cast<float>(w.x) * ab + static_cast<float>(w.y) * ac;
    const Point3f p = on_surface + (surface_offset_m + lean_ahead_m(piece, on_surface.z)) * piece.normal;
    receivers.push_back({t, area_m2 / static_cast<float>(count), p, piece.normal, locators.is_buried(p)});
  }
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
                           std::span<const std::size_t> chosen, HeightAbove above, float height_m, const std::stop_token& stop,
                           std::span<double> above_ground_m) {
  const Grid& grid = package.grid();
  const Cell existing = nearest_existing(cell, grid.cells);
  const PointLocator locator(package, existing);
  const bool is_outside = cell != existing;
  std::optional<FarGround> far_ground;
  if (is_outside) far_ground.emplace(package, cell);
  CellReceivers result{cell, {}};
  for (const std::size_t n : chosen) {
    throw_if_cancelled(stop);
    const Point2d p_grid = package.manifest().grid_from_projected(places[n].p_projected);
    const Point2d p_cell = p_grid - grid.corner_of(cell), within = cell_point_within(p_grid, existing, grid);
    const auto x = static_cast<float>(p_cell.x), y = static_cast<float>(p_cell.y);
    const VerticalProfile profile = is_outside ? profile_outside(*far_ground, locator, p_cell, within) : locator.at(x, y);
    const auto [from, height] = height_of_place(places[n], above, height_m, package.manifest().height_origin_m);
    const auto standing = is_outside ? stand_outside(profile, {x, y}, from, height) : stand(profile, x, y, from, height);
    if (!standing) continue;
    result.receivers.push_back({n, *standing, places[n].normal_grid});
    if (const auto ground_m = profile.ground_m(); ground_m && !above_ground_m.empty())
      above_ground_m[n] = static_cast<double>(standing->z - *ground_m);
  }
  return result;
}

std::vector<SurfaceReceiver> surface_receivers(const PackageReader& package, Cell cell, SurfaceChoice choice, double spacing_m,
                                               const std::stop_token& stop) {
  const TileView tile = package.tile(cell);
  LocatorsAround locators(package, cell);
  std::vector<SurfaceReceiver> receivers;
  std::uint32_t begin = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    if (is_chosen(tile.surfaces[run.surface].kind(), choice)) {
      const Piece piece = piece_of(tile, begin, run);
      for (std::uint32_t t = begin; t < run.end; ++t) spread(tile, piece, t, spacing_m, locators, stop, receivers);
    }
    begin = run.end;
  }
  return receivers;
}

}  // namespace farlod
