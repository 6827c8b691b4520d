// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/zones_of_grid.hpp"

#include <cmath>
#include <cstdint>
#include <string>

#include "base/run_settings.hpp"
#include "farlod/error.hpp"
#include "run/package_contents.hpp"

namespace farlod {
namespace {

Zone in_grid_frame(const Zone& zone, const package::Manifest& m) {
  Zone rings = zone;
  for (auto& ring : rings)
    for (Point2d& p : ring) {
      require_coordinate("a coordinate of a zone", p.x);
      require_coordinate("a coordinate of a zone", p.y);
      p = m.grid_from_projected(p);
    }
  return rings;
}

double area_of_zone(const std::vector<ZoneTrapezoid>& trapezoids, std::size_t number) {
  double area_m2 = 0.0;
  for (const ZoneTrapezoid& t : trapezoids) area_m2 += t.area_m2();
  if (area_m2 > 0.0) return area_m2;
  throw InvalidArgument("zone " + std::to_string(number) + " (counted from 0) has no area: give polygons, or leave it out");
}

[[noreturn]] void throw_beyond(const std::vector<Zone>& zones, const package::Manifest& m) {
  Box2d box;
  for (const Zone& zone : zones)
    for (const auto& ring : zone)
      for (const Point2d p : ring) box.add(p);
  const Box2d city = m.projected_outline(m.grid.rectangle());
  const auto text = [](Point2d p) { return std::to_string(std::llround(p.x)) + ", " + std::to_string(std::llround(p.y)); };
  throw InvalidArgument("none of " + std::to_string(zones.size()) + " zones lies in the city: they lie from " + text(box.low) +
                        " to " + text(box.high) + ", and the grid of the city from " + text(city.low) + " to " + text(city.high) +
                        ". Give zones of this city, or check whether they are in another CRS");
}

}  // namespace

ZonesOfGrid::ZonesOfGrid(const package::Manifest& manifest, const std::vector<Zone>& zones)
    : manifest_(manifest), grid_(manifest.grid) {
  std::map<std::size_t, ZonesInCell> by_cell;
  for (std::size_t n = 0; n < zones.size(); ++n) {
    const std::vector<ZoneTrapezoid> trapezoids = trapezoids_of(in_grid_frame(zones[n], manifest));
    plan_areas_m2_.push_back(area_of_zone(trapezoids, n));
    is_met_.push_back(false);
    for (const ZoneTrapezoid& t : trapezoids) add(n, t, by_cell);
  }
  cells_.assign(by_cell.begin(), by_cell.end());
  if (!zones.empty() && cells_.empty()) throw_beyond(zones, manifest);
}

void ZonesOfGrid::add(std::size_t zone, const ZoneTrapezoid& t, std::map<std::size_t, ZonesInCell>& by_cell) {
  // A wall on its border may be of the next cell
  constexpr double margin_m = 0.001;
  const Box2d box = grown(t.outline(), margin_m);
  const auto number = [&](double x) { return static_cast<std::int32_t>(std::floor(x / grid_.cell_edge_m)); };
  const CellRange all =
      CellRange{number(box.low.x), number(box.low.y), number(box.high.x) + 1, number(box.high.y) + 1}.intersection(grid_.cells);
  for (std::int32_t j = all.j_begin; j < all.j_end; ++j)
    for (std::int32_t i = all.i_begin; i < all.i_end; ++i) {
      by_cell[grid_.cells.index_of({i, j})][zone].push_back(t.moved_to(grid_.corner_of({i, j})));
      is_met_[zone] = true;
    }
}

Box2d ZonesOfGrid::outline_projected() const {
  Box2d all;
  for (const auto& [index, zones] : cells_) {
    const Box2d cell = manifest_.projected_outline(grid_.square_of(grid_.cells.cell_at(index)));
    all.add(cell.low);
    all.add(cell.high);
  }
  return all;
}

}  // namespace farlod
