// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "ingest/ring_cleaning.hpp"

namespace farlod {

/// Remembers the polygons of one part of a building, to find copies: files give the same surface once as the boundary of
/// a solid and once as a semantic surface. Copies have the same corners, whichever comes first and whichever way round.
class SeenPolygons {
 public:
  /// False when a polygon with these corners was inserted before.
  bool insert(const Rings& rings) { return seen_.insert(corners_of(rings)).second; }
  [[nodiscard]] bool contains(const Rings& rings) const { return seen_.contains(corners_of(rings)); }

 private:
  using Corner = std::tuple<double, double, double>;

  static std::vector<Corner> corners_of(const Rings& rings) {
    std::vector<Corner> corners;
    for (const Ring& ring : rings)
      for (const Point3d& p : ring) corners.emplace_back(key(p.x), key(p.y), key(p.z));
    std::sort(corners.begin(), corners.end());
    // A format may repeat the first point of a ring, and the copy begins elsewhere
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
  }
  /// NaN has no place in an order.
  static double key(double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x; }

  std::set<std::vector<Corner>> seen_;
};

}  // namespace farlod
