// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// Twice the signed area of a triangle with these sides: positive if b is to the left of a.
[[nodiscard]] inline double across(Point2d a, Point2d b) { return a.x * b.y - a.y * b.x; }

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

/// An order of points, by which results do not depend on the order of the input.
[[nodiscard]] inline bool comes_first(const Point3d& a, const Point3d& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Whether two closed sequences are the same, wherever each of them begins. Takes time in proportion to their length: the
/// sequences of hostile files repeat themselves, so that each of their turns has to be compared nearly to its end.
template <class Sequence, class Other>
[[nodiscard]] bool is_rotation_of(const Sequence& a, const Other& b) {
  const std::size_t n = std::size(a);
  if (n != std::size(b)) return false;
  if (n == 0) return true;
  // Knuth, Morris & Pratt: search a in b b. failure[k] is the longest beginning of a that ends at a[k], without all of it
  std::vector<std::size_t> failure(n, 0);
  for (std::size_t k = 1, length = 0; k < n; ++k) {
    while (length > 0 && !(a[k] == a[length])) length = failure[length - 1];
    if (a[k] == a[length]) ++length;
    failure[k] = length;
  }
  for (std::size_t k = 0, length = 0; k < 2 * n; ++k) {
    while (length > 0 && !(b[k % n] == a[length])) length = failure[length - 1];
    if (b[k % n] == a[length]) ++length;
    if (length == n) return true;
  }
  return false;
}

/// Figures in messages: three digits after the point are a millimetre.
[[nodiscard]] inline std::string metres(double value) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 4) + " m";
}

}  // namespace farlod
