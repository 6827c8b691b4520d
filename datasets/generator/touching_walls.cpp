// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/touching_walls.hpp"

#include <algorithm>
#include <cmath>

namespace farlod {

TouchingWalls::TouchingWalls(std::span<const BuildingPlan> plans) {
  for (std::size_t n = 0; n < plans.size(); ++n) {
    const std::vector<Point2d> ring = footprint_ring(plans[n]);
    const LotFrame& lot = plans[n].lot;
    for (std::size_t k = 0; k < ring.size(); ++k)
      lines_.push_back(line_of(n, lot.plan_from_lot(ring[k]), lot.plan_from_lot(ring[(k + 1) % ring.size()])));
  }
}

TouchingWalls::Line TouchingWalls::line_of(std::size_t building, Point2d a, Point2d b) {
  const auto cm = [](double x_m) { return static_cast<std::int64_t>(std::llround(100.0 * x_m)); };
  const std::array from{cm(a.x), cm(a.y)}, to{cm(b.x), cm(b.y)};
  return {building, std::min(from, to), std::max(from, to)};
}

bool TouchingWalls::touches(const Line& line) const {
  return std::ranges::any_of(lines_, [&line](const Line& other) {
    if (other.building == line.building) return false;
    // Two segments overlap if their intervals on one axis overlap and their positions on the other are equal
    for (const std::size_t across : {0U, 1U}) {
      const std::size_t along = 1 - across;
      const bool in_line = line.low_cm[across] == line.high_cm[across] && other.low_cm[across] == other.high_cm[across] &&
                           line.low_cm[across] == other.low_cm[across];
      if (in_line && line.low_cm[along] < other.high_cm[along] && other.low_cm[along] < line.high_cm[along]) return true;
    }
    return false;
  });
}

bool TouchingWalls::touches(std::size_t building, Point2d a, Point2d b) const { return touches(line_of(building, a, b)); }

bool TouchingWalls::touches_any(std::size_t building) const {
  return std::ranges::any_of(lines_, [&](const Line& line) { return line.building == building && touches(line); });
}

}  // namespace farlod
