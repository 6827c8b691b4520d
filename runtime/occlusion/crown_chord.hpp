// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/point.hpp"
#include "package/crown.hpp"

namespace farlod {

/// The part of a line that lies within a body: from `begin` to `end`, in lengths of the line's direction. A line that only
/// touches the body has no such part.
struct Chord {
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();

  [[nodiscard]] static Chord none() { return {0.0, 0.0}; }
  [[nodiscard]] bool is_none() const { return !(begin < end); }
  [[nodiscard]] Chord within(const Chord& other) const { return {std::max(begin, other.begin), std::min(end, other.end)}; }
};

/// Of the line p + t d with |x| ≤ half.
[[nodiscard]] inline Chord chord_of_slab(double p, double d, double half) {
  if (d == 0.0) return std::abs(p) < half ? Chord{} : Chord::none();
  const double a = (-half - p) / d, b = (half - p) / d;
  return {std::min(a, b), std::max(a, b)};
}

/// Of a line with the unit ball, or with the unit circle times the z axis where both z are 0. The place that is nearest to the
/// middle comes first: the usual formula loses all digits of a ball that is far away.
[[nodiscard]] inline Chord chord_of_unit_ball(const Point3d& p, const Point3d& d) {
  const double dd = dot(d, d);
  if (dd == 0.0) return dot(p, p) < 1.0 ? Chord{} : Chord::none();
  const double middle = -dot(p, d) / dd;
  const Point3d nearest = p + middle * d;
  const double rest = 1.0 - dot(nearest, nearest);
  if (!(rest > 0.0)) return Chord::none();
  const double half = std::sqrt(rest / dd);
  return {middle - half, middle + half};
}

/// The turn of a prism, which is the same for all rays.
struct CrownTurn {
  double cosine = 1.0, sine = 0.0;

  explicit CrownTurn(const Crown& crown) {
    if (crown.shape == CrownShape::prism) cosine = std::cos(crown.turn_rad()), sine = std::sin(crown.turn_rad());
  }
};

/// Of a line with a crown, in the crown's frame. The direction is not 0.
[[nodiscard]] inline Chord chord_of(const Crown& crown, const CrownTurn& turn, const Point3d& origin, const Point3d& direction) {
  const double half_height_m = 0.5 * (static_cast<double>(crown.top_m) - crown.bottom_m), half_width_m = crown.half_width_m;
  const Point3d p{origin.x - crown.x_m, origin.y - crown.y_m, origin.z - crown.bottom_m - half_height_m};
  const auto scaled = [&](const Point3d& v, double z) { return Point3d{v.x / half_width_m, v.y / half_width_m, z}; };
  if (crown.shape == CrownShape::spheroid)
    return chord_of_unit_ball(scaled(p, p.z / half_height_m), scaled(direction, direction.z / half_height_m));
  const Chord layer = chord_of_slab(p.z, direction.z, half_height_m);
  if (crown.shape == CrownShape::cylinder) return layer.within(chord_of_unit_ball(scaled(p, 0.0), scaled(direction, 0.0)));
  const double c = turn.cosine, s = turn.sine;
  return layer.within(chord_of_slab(c * p.x + s * p.y, c * direction.x + s * direction.y, half_width_m))
      .within(chord_of_slab(c * p.y - s * p.x, c * direction.y - s * direction.x, half_width_m));
}
[[nodiscard]] inline Chord chord_of(const Crown& crown, const Point3d& origin, const Point3d& direction) {
  return chord_of(crown, CrownTurn(crown), origin, direction);
}

}  // namespace farlod
