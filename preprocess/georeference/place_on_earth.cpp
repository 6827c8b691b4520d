// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "georeference/place_on_earth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/expects.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

std::string country_in(std::string_view area_name) {
  const std::size_t end = area_name.find(" - ");
  std::string_view name = area_name.substr(0, end);
  if (name.ends_with('.')) name.remove_suffix(1);
  // What follows a part of a country may be another one: "Japan - onshore; South Korea - onshore"
  const bool is_list = name.find_first_of(",.:") != name.npos || (end != area_name.npos && area_name.find(';') != area_name.npos);
  const bool is_zone = name.find_first_of("0123456789") != name.npos;
  constexpr std::array continents{"World", "Europe", "Africa", "Asia", "North America", "South America", "Antarctica"};
  const bool is_continent = std::any_of(continents.begin(), continents.end(), [&](auto c) { return name.starts_with(c); });
  return is_list || is_zone || is_continent ? "" : std::string(name);
}

namespace {

/// Datums on the ellipsoids GRS 80 and WGS 84 lie around the middle of the Earth, and differ by a few metres. PROJ searches
/// for a hundredth of a second for some of these shifts.
bool is_geocentric(const Crs& crs) {
  const Ellipsoid ellipsoid = crs.ellipsoid();
  return ellipsoid.semi_major_m == 6378137.0 && std::abs(ellipsoid.inverse_flattening - 298.2572) < 1e-4;
}

bool lies_on_earth(Point2d lon_lat_deg) { return std::abs(lon_lat_deg.x) <= 180.0 && std::abs(lon_lat_deg.y) <= 90.0; }

}  // namespace

std::string degrees_text(Point2d lon_lat_deg) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << std::abs(lon_lat_deg.y) << (lon_lat_deg.y < 0.0 ? "° S, " : "° N, ")
       << std::abs(lon_lat_deg.x) << (lon_lat_deg.x < 0.0 ? "° W" : "° E");
  return text.str();
}

PlaceOnEarth place_of(const Georeference& georeference) {
  const auto crs = Crs::find(georeference.crs_wkt);
  FARLOD_EXPECTS(crs.has_value());
  const Point2d middle = georeference.origin_m;
  PlaceOnEarth place{is_geocentric(*crs) ? crs->lon_lat_deg(middle) : crs->wgs84_lon_lat_deg(middle), ""};
  if (place.lon_lat_deg && !lies_on_earth(*place.lon_lat_deg)) place.lon_lat_deg.reset();
  const auto area = crs->area_of_use();
  if (place.lon_lat_deg && area && area->contains(*place.lon_lat_deg)) place.country = country_in(crs->area_name());
  return place;
}

}  // namespace farlod::georeference
