// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/projection.hpp"

#include <cmath>
#include <limits>

#include "georeference/utm_projection.hpp"

namespace farlod::georeference {
namespace {

/// Larger than all coordinates of maps of the Earth, including eastings that begin with a zone number.
constexpr double beyond_all_maps_m = 1e8;

void project_to_utm(std::span<Point3d> points, const UtmProjection& utm) {
  for (Point3d& p : points) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    const Point2d there = utm.projected(horizontal(p)).value_or(Point2d{nowhere, nowhere});
    p = {there.x, there.y, p.z};
  }
}

}  // namespace

Projection make_projection(const Crs& from, const Crs& to, Point2d typical) {
  // Coordinates in the output CRS stay the same, to the last bit
  if (from.equals(to)) return [](std::span<Point3d>) {};
  // Between two units of the same projection, coordinates differ by a factor
  if (from.is_projected() && from.unit() != 1.0 && from.counted_in(metre).equals(to))
    return [unit_m = from.unit()](std::span<Point3d> points) {
      for (Point3d& p : points) p = {unit_m * p.x, unit_m * p.y, p.z};
    };
  // UTM on the same datum is a formula without a datum shift
  if (const auto zone = to.utm_zone(); zone && from.is_in_degrees_from_greenwich() && to.geographic().equals(from))
    return [utm = UtmProjection(*zone, to.ellipsoid())](std::span<Point3d> points) { project_to_utm(points, utm); };
  return [way = CrsTransformation(from, to, typical)](std::span<Point3d> points) { way.apply(points); };
}

bool is_on_a_map(const Point3d& p) { return std::abs(p.x) < beyond_all_maps_m && std::abs(p.y) < beyond_all_maps_m; }

}  // namespace farlod::georeference
