// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/citygml/citygml_placement.hpp"

#include <algorithm>
#include <cmath>

namespace farlod::ingest {

std::optional<Placement> Placement::from(std::span<const double> m, const Point3d& reference_point) {
  if (m.empty()) return Placement({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, reference_point);
  if (m.size() != 16 || !std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); })) return std::nullopt;
  return Placement({m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, Point3d{m[3], m[7], m[11]} + reference_point);
}

Point3d Placement::place(const Point3d& p) const { return origin_ + p.x * x_axis_ + p.y * y_axis_ + p.z * z_axis_; }

Rings Placement::place(const Rings& rings_prototype) const {
  const bool mirrors = dot(cross(x_axis_, y_axis_), z_axis_) < 0.0;
  Rings rings = rings_prototype;
  for (Ring& ring : rings) {
    for (Point3d& p : ring) p = place(p);
    if (mirrors) std::reverse(ring.begin(), ring.end());
  }
  return rings;
}

}  // namespace farlod::ingest
