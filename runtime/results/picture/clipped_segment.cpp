// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "results/picture/drawing.hpp"

namespace farlod {
namespace {

/// Shortens the part [begin, end] of a line to where its coordinate, which goes by `step` from `from`, lies between two bounds.
/// Returns whether anything is left.
bool shorten(double from, double step, double low, double high, double& begin, double& end) {
  if (step == 0.0) return low <= from && from <= high;
  const double at_low = (low - from) / step, at_high = (high - from) / step;
  begin = std::max(begin, std::min(at_low, at_high));
  end = std::min(end, std::max(at_low, at_high));
  return begin <= end;
}

}  // namespace

std::optional<Segment> clipped(const Segment& segment, PagePoint upper_left, PagePoint lower_right) {
  // Liang and Barsky (1984)
  const PagePoint &a = segment.a, &b = segment.b;
  double begin = 0.0, end = 1.0;
  if (!shorten(a.x, b.x - a.x, upper_left.x, lower_right.x, begin, end) ||
      !shorten(a.y, b.y - a.y, upper_left.y, lower_right.y, begin, end))
    return std::nullopt;
  const auto at = [&](double share) { return PagePoint{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; };
  return Segment{at(begin), at(end)};
}

}  // namespace farlod
