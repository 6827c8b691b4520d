// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "farlod/box.hpp"

namespace farlod {

/// Whether two boxes share a point.
[[nodiscard]] inline bool boxes_meet(const Box2d& a, const Box2d& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Between two boxes; 0 where they meet.
[[nodiscard]] inline double distance_m(const Box2d& a, const Box2d& b) {
  const double x = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
  const double y = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
  return std::sqrt(x * x + y * y);
}

}  // namespace farlod
