// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/run_settings.hpp"
#include "farlod/error.hpp"
#include "farlod/morphology.hpp"
#include "run/cell_amounts.hpp"
#include "run/cell_crowns.hpp"
#include "run/cell_faces.hpp"
#include "run/cells_in_parallel.hpp"
#include "run/memory_limit.hpp"
#include "run/morphology_of_package.hpp"
#include "run/package_contents.hpp"
#include "run/zone_plan.hpp"

namespace farlod {
namespace {

/// The zones that a cell meets, by their numbers, and where: grid frame.
using ZonesInCell = std::map<std::size_t, std::vector<ZoneTrapezoid>>;

/// What a cell has of a zone.
struct ZoneInCell {
  std::size_t zone = 0;
  CellForm form;
  std::optional<CellVegetation> vegetation;
};

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

/// Where zones lie, cell by cell.
class ZonesOfGrid {
 public:
  ZonesOfGrid(const package::Manifest& m, const std::vector<Zone>& zones) : grid_(m.grid) {
    for (std::size_t n = 0; n < zones.size(); ++n) {
      const std::vector<ZoneTrapezoid> trapezoids = trapezoids_of(in_grid_frame(zones[n], m));
      plan_areas_m2_.push_back(area_of_zone(trapezoids, n));
      is_met_.push_back(false);
      for (const ZoneTrapezoid& t : trapezoids) add(n, t);
    }
    cells_.insert(cells_.end(), by_cell_.begin(), by_cell_.end());
    if (!zones.empty() && cells_.empty()) throw_beyond(zones, m);
  }
  /// None of one that lies beyond the grid.
  [[nodiscard]] double plan_area_m2(std::size_t zone) const { return is_met_[zone] ? plan_areas_m2_[zone] : 0.0; }
  /// Those that zones meet, by their places in the grid.
  [[nodiscard]] const std::vector<std::pair<std::size_t, ZonesInCell>>& cells() const { return cells_; }

 private:
  void add(std::size_t zone, const ZoneTrapezoid& t) {
    // A wall on its border may be of the next cell
    constexpr double margin_m = 0.001;
    const Box2d box = t.outline();
    const Point2d margin{margin_m, margin_m}, low = box.low - margin, high = box.high + margin;
    const auto number = [&](double x) { return static_cast<std::int32_t>(std::floor(x / grid_.cell_edge_m)); };
    const CellRange all =
        CellRange{number(low.x), number(low.y), number(high.x) + 1, number(high.y) + 1}.intersection(grid_.cells);
    for (std::int32_t j = all.j_begin; j < all.j_end; ++j)
      for (std::int32_t i = all.i_begin; i < all.i_end; ++i)
        by_cell_[grid_.cells.index_of({i, j})][zone].push_back(t.moved_to(grid_.corner_of({i, j})));
    if (all.size() > 0) is_met_[zone] = true;
  }
  const Grid& grid_;
  std::vector<double> plan_areas_m2_;
  std::vector<bool> is_met_;
  std::map<std::size_t, ZonesInCell> by_cell_;
  std::vector<std::pair<std::size_t, ZonesInCell>> cells_;
};

std::vector<ZoneInCell> zones_in(const PackageReader& reader, Cell cell, const ZonesInCell& zones, const WindDirections& winds) {
  const CellFaces faces = faces_of(reader, cell);
  std::vector<ZoneInCell> result;
  for (const auto& [zone, trapezoids] : zones)
    result.push_back({zone, form_of(faces, winds, &trapezoids), vegetation_of(reader, cell, faces, &trapezoids)});
  return result;
}

void add_vegetation(const CellVegetation& from, CellVegetation& to) {
  to.plan_area_m2 += from.plan_area_m2;
  const std::size_t count = to.count + from.count;
  if (count > 0)
    to.height_mean_m = (to.height_mean_m * static_cast<double>(to.count) + from.height_mean_m * static_cast<double>(from.count)) /
                       static_cast<double>(count);
  to.count = count;
}

/// In the order of the cells, whatever the number of threads.
std::vector<UrbanForm> sums_of(const std::vector<std::vector<ZoneInCell>>& parts, const ZonesOfGrid& zones, std::size_t count,
                               bool has_crowns) {
  std::vector<CellForm> forms(count);
  std::vector<UrbanForm> result(count);
  if (has_crowns)
    for (UrbanForm& form : result) form.vegetation = CellVegetation{};
  for (const auto& of_cell : parts)
    for (const ZoneInCell& part : of_cell) {
      forms[part.zone].add(part.form);
      if (part.vegetation) add_vegetation(*part.vegetation, *result[part.zone].vegetation);
    }
  for (std::size_t n = 0; n < count; ++n) {
    result[n].amounts = forms[n].all();
    result[n].amounts.plan_area_m2 = zones.plan_area_m2(n);
  }
  return result;
}

}  // namespace

std::vector<UrbanForm> morphology_of_zones(const Package& package, const std::vector<Zone>& zones, const RunSettings& run) {
  require_usable(run);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  require_buildings_cut_at_borders(reader.manifest());
  const ZonesOfGrid where(reader.manifest(), zones);
  require_memory(run, static_cast<double>(zones.size() * sizeof(UrbanForm) + bytes_of_blocks_at_work(reader.manifest())),
                 "describing zones", "give fewer of them at a time");
  const WindDirections winds = winds_of(reader.manifest());
  std::vector<std::vector<ZoneInCell>> parts(where.cells().size());
  for_each_cell(parts.size(), run, "cells", [&](std::size_t n) {
    const auto& [index, in_cell] = where.cells()[n];
    parts[n] = zones_in(reader, reader.grid().cells.cell_at(index), in_cell, winds);
  });
  return sums_of(parts, where, zones.size(), reader.has_crowns());
}

}  // namespace farlod
