// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/angle.hpp"

namespace farlod::align {

/// How a wall comes out of a file.
enum class WallCut { whole, rising_diagonal, falling_diagonal };

/// Adds walls, floor and roof above a ring that is not closed.
inline void add_extruded(CityModel& city, const std::vector<Point2d>& ring, double height_m, WallCut cut = WallCut::whole) {
  city.begin_building("building " + std::to_string(city.buildings().size()));
  std::uint32_t surface = 0;
  const auto add = [&](const std::vector<Point3d>& polygon) {
    city.begin_facet(SurfaceKind::unknown, surface++);
    city.add_ring(polygon);
  };
  std::vector<Point3d> floor, roof;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d p = ring[k], q = ring[(k + 1) % ring.size()];
    const Point3d a{p.x, p.y, 0}, b{q.x, q.y, 0}, c{q.x, q.y, height_m}, d{p.x, p.y, height_m};
    if (cut == WallCut::whole) add({a, b, c, d});
    if (cut == WallCut::rising_diagonal) add({a, b, c}), add({a, c, d});
    if (cut == WallCut::falling_diagonal) add({a, b, d}), add({b, c, d});
    floor.insert(floor.begin(), a);
    roof.push_back(d);
  }
  add(floor);
  add(roof);
}

/// A rectangle of 30 m by 12 m around a centre, whose longer side has the given bearing.
inline std::vector<Point2d> rectangle(Point2d centre, Angle bearing, double scale = 1.0) {
  const Point2d along = 15.0 * scale * Point2d{sin(bearing), cos(bearing)},
                across = 6.0 * scale * Point2d{cos(bearing), -sin(bearing)};
  return {centre - along - across, centre - along + across, centre + along + across, centre + along - across};
}

/// `count` rectangles of one bearing, in rows of ten, 50 m apart.
inline void add_quarter(CityModel& city, int count, Angle bearing, Point2d corner = {}) {
  for (int k = 0; k < count; ++k)
    add_extruded(city, rectangle(corner + Point2d{50.0 * (k % 10), 50.0 * (k / 10)}, bearing), 10.0);
}

/// A round building of `sides` walls.
inline void add_round(CityModel& city, int sides) {
  std::vector<Point2d> ring;
  for (int k = 0; k < sides; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / sides;
    ring.push_back({100.0 * std::cos(turn), 100.0 * std::sin(turn)});
  }
  add_extruded(city, ring, 10.0);
}

}  // namespace farlod::align
