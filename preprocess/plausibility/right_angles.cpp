// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/right_angles.hpp"

#include <cmath>
#include <numbers>
#include <span>

#include "city/geometry.hpp"

namespace farlod::plausibility {
namespace {

/// The sides of a corner, in degrees.
struct Corner {
  Point2d before, behind;

  /// The cosine of its angle where x is so much shorter than y.
  [[nodiscard]] double cosine(double scale_x, double scale_y) const {
    const Point2d a{scale_x * before.x, scale_y * before.y}, b{scale_x * behind.x, scale_y * behind.y};
    return std::abs(dot(a, b)) / (norm(a) * norm(b));
  }
};

double cosine_of_deg(double angle_deg) { return std::cos(angle_deg * std::numbers::pi / 180.0); }

void add_corner(const Corner& corner, Point2d p, RightAngles& found) {
  // Coordinates with six digits turn a side of 4 m by up to 2°; an angle of less than 25° is none, or a spike
  constexpr double least_side_deg = 4.0 / metres_in_a_degree, cosine_of_right = 0.06, cosine_of_none = 0.9, pole_deg = 90.0;
  if (std::abs(p.x) >= pole_deg || std::abs(p.y) >= pole_deg) return;
  if (norm(corner.before) < least_side_deg || norm(corner.behind) < least_side_deg) return;
  const double as_read = corner.cosine(cosine_of_deg(p.y), 1.0), exchanged = corner.cosine(1.0, cosine_of_deg(p.x));
  if (as_read > cosine_of_none && exchanged > cosine_of_none) return;
  ++found.corners;
  found.as_read += as_read < cosine_of_right ? 1 : 0;
  found.exchanged += exchanged < cosine_of_right ? 1 : 0;
  found.in_degrees += corner.cosine(1.0, 1.0) < cosine_of_right ? 1 : 0;
}

void add_ring(std::span<const Point3d> ring, RightAngles& found) {
  for (std::size_t n = 0; n < ring.size(); ++n) {
    const Point2d p = horizontal(ring[n]);
    const Point2d before = horizontal(ring[(n + ring.size() - 1) % ring.size()]),
                  behind = horizontal(ring[(n + 1) % ring.size()]);
    add_corner({before - p, behind - p}, p, found);
  }
}

}  // namespace

bool RightAngles::speak_for_exchange() const {
  constexpr std::size_t enough = 80;
  return corners >= enough && 2 * exchanged >= corners && 2 * as_read <= exchanged && 10 * in_degrees < 9 * exchanged;
}

RightAngles right_angles_of(const CityModel& city) {
  RightAngles found;
  city.for_each_building([&](std::size_t, const Building& b) {
    for (const Facet& facet : city.facets_of(b)) add_ring(city.ring(facet, 0), found);
  });
  return found;
}

}  // namespace farlod::plausibility
