// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/exact_sky.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "base/expects.hpp"

namespace farlod {

double ExactSky::sky_of_wedge(const Wedge& wedge, const Point3d& place, const Point3f& normal, SkyWeight weight) {
  const Point3d unit_normal = normalized(Point3d{normal.x, normal.y, normal.z});
  const TriangleIndex::Sector sector{place, wedge.from, wedge.tangent, unit_normal};
  if (kind_ == Triangles::of_unbroken_surface) return sky_above_edges(wedge, sector, weight);
  sky_.begin(wedge, unit_normal, weight);
  double lowest = sky_.sky().lowest;
  // What is seen is looked at each time that the triangles have doubled: what is farther and lower hides nothing
  std::size_t count = 0, next_look = 16;
  triangles_.find(sector, lowest, [&](std::span<const TriangleIndex::Corners> triangles) {
    for (const TriangleIndex::Corners& triangle : triangles) sky_.add(triangle);
    count += triangles.size();
    if (count >= next_look) {
      lowest = sky_.sky().lowest;
      next_look = 2 * count;
    }
    return lowest;
  });
  return sky_.sky().sky;
}

double ExactSky::sky_above_edges(const Wedge& wedge, const TriangleIndex::Sector& sector, SkyWeight weight) {
  envelope_.begin(wedge, sector.normal, weight);
  double lowest = envelope_.sky().lowest;
  constexpr std::size_t often = 16;
  std::size_t count = 0;
  triangles_.find(sector, lowest, [&](std::span<const TriangleIndex::Corners> triangles) {
    for (const TriangleIndex::Corners& triangle : triangles)
      for (std::size_t n = 0; n < triangle.size(); ++n) envelope_.add(triangle[n], triangle[(n + 1) % triangle.size()]);
    count += triangles.size();
    if (count >= often) {
      lowest = envelope_.sky_of_kept_envelope().lowest;
      count = 0;
    }
    return lowest;
  });
  return envelope_.sky().sky;
}

double ExactSky::share_of_sky(std::size_t wedges, const Point3d& place, const Point3f& normal, SkyWeight weight) {
  FARLOD_EXPECTS(wedges >= 5);
  constexpr double turn = 2.0 * std::numbers::pi;
  const double width = turn / static_cast<double>(wedges);
  double sum = 0.0;
  for (std::size_t k = 0; k < wedges; ++k) {
    const double azimuth = width * static_cast<double>(k);
    sum += sky_of_wedge({{std::cos(azimuth), std::sin(azimuth)}, std::tan(width)}, place, normal, weight);
  }
  return sum / turn;
}

}  // namespace farlod
