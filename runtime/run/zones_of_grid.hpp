// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/morphology.hpp"
#include "package/manifest.hpp"
#include "run/zone_plan.hpp"

namespace farlod {

/// The zones that a cell meets, by their numbers, and where: cell frame.
using ZonesInCell = std::map<std::size_t, std::vector<ZoneTrapezoid>>;

/// Where zones lie, cell by cell.
class ZonesOfGrid {
 public:
  /// The manifest must outlive it. Throws what morphology_of_zones throws of zones.
  ZonesOfGrid(const package::Manifest& manifest, const std::vector<Zone>& zones);

  /// None of one that lies beyond the grid.
  [[nodiscard]] double plan_area_m2(std::size_t zone) const { return is_met_[zone] ? plan_areas_m2_[zone] : 0.0; }
  /// Those that zones meet, by their places in the grid, ascending.
  [[nodiscard]] const std::vector<std::pair<std::size_t, ZonesInCell>>& cells() const { return cells_; }
  /// Around these cells, projected; empty without zones.
  [[nodiscard]] Box2d outline_projected() const;
  /// Calls f(zone) for each that a place of the grid frame lies in.
  template <class F>
  void visit(Point2d p_grid, const F& f) const {
    const Cell cell = grid_.cell_of(p_grid);
    if (!grid_.cells.contains(cell)) return;
    const auto here =
        std::ranges::lower_bound(cells_, grid_.cells.index_of(cell), {}, &std::pair<std::size_t, ZonesInCell>::first);
    if (here == cells_.end() || here->first != grid_.cells.index_of(cell)) return;
    const Point2d p_cell = p_grid - grid_.corner_of(cell);
    for (const auto& [zone, trapezoids] : here->second)
      if (std::ranges::any_of(trapezoids, [&](const ZoneTrapezoid& t) { return t.contains(p_cell); })) f(zone);
  }

 private:
  void add(std::size_t zone, const ZoneTrapezoid& t, std::map<std::size_t, ZonesInCell>& by_cell);

  const package::Manifest& manifest_;
  const Grid& grid_;
  std::vector<double> plan_areas_m2_;
  std::vector<bool> is_met_;
  std::vector<std::pair<std::size_t, ZonesInCell>> cells_;
};

}  // namespace farlod
