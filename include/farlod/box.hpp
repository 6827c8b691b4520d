// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "farlod/point.hpp"

namespace farlod {

/// An upright rectangle of the plane. Starts empty (low > high), and grows.
struct Box2d {
  Point2d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point2d high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  bool operator==(const Box2d&) const = default;

  [[nodiscard]] constexpr bool empty() const { return !(low.x <= high.x && low.y <= high.y); }
  [[nodiscard]] constexpr bool contains(Point2d p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
  }
  constexpr void add(Point2d p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// A box and all that is no farther from it along either axis.
[[nodiscard]] constexpr Box2d grown(const Box2d& box, double margin_m) {
  return {{box.low.x - margin_m, box.low.y - margin_m}, {box.high.x + margin_m, box.high.y + margin_m}};
}

}  // namespace farlod
