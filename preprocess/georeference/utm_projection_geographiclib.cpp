// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>

#include "georeference/crs.hpp"

namespace farlod::georeference {
namespace {

constexpr double false_easting_m = 500000.0;
/// Slightly beyond the pole, where the northings of a hemisphere end.
constexpr double farthest_northing_m = 1e7;

double false_northing_m(UtmZone zone) { return zone.north ? 0.0 : 1e7; }
double central_meridian_deg(UtmZone zone) { return 6.0 * zone.number - 183.0; }

GeographicLib::TransverseMercator projection(const Ellipsoid& e) {
  const double flattening = e.inverse_flattening > 0.0 ? 1.0 / e.inverse_flattening : 0.0;
  return {e.semi_major_m, flattening, GeographicLib::Constants::UTM_k0()};
}

}  // namespace

UtmZone utm_zone_of(Point2d lon_lat_deg) {
  return {GeographicLib::UTMUPS::StandardZone(lon_lat_deg.y, lon_lat_deg.x, GeographicLib::UTMUPS::UTM), lon_lat_deg.y >= 0.0};
}

std::optional<Point2d> UtmProjection::projected(Point2d lon_lat_deg) const {
  if (!(std::abs(lon_lat_deg.y) <= 90.0 && std::abs(lon_lat_deg.x) <= 360.0)) return std::nullopt;
  Point2d p;
  projection(ellipsoid_).Forward(central_meridian_deg(zone_), lon_lat_deg.y, lon_lat_deg.x, p.x, p.y);
  if (!(std::abs(p.x) <= false_easting_m && std::abs(p.y) <= farthest_northing_m)) return std::nullopt;
  return p + Point2d{false_easting_m, false_northing_m(zone_)};
}

Point2d UtmProjection::lon_lat_deg(Point2d p_projected) const {
  const Point2d p = p_projected - Point2d{false_easting_m, false_northing_m(zone_)};
  Point2d result;
  projection(ellipsoid_).Reverse(central_meridian_deg(zone_), p.x, p.y, result.y, result.x);
  return result;
}

Angle UtmProjection::convergence_at(Point2d p_projected) const {
  const Point2d p = p_projected - Point2d{false_easting_m, false_northing_m(zone_)};
  double lat = 0.0, lon = 0.0, convergence_deg = 0.0, scale = 0.0;
  projection(ellipsoid_).Reverse(central_meridian_deg(zone_), p.x, p.y, lat, lon, convergence_deg, scale);
  return Angle::degrees(convergence_deg);
}

}  // namespace farlod::georeference
