// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "city/city_model.hpp"

namespace farlod::georeference {

/// Two series, each good to 5 nm (Karney 2011), from degrees whose last bit is 3 nm: PROJ and GeographicLib may differ by this.
inline constexpr double two_series_m = 2.0 * (5e-9 + 3e-9);

/// One triangle that stands for a building: enough to be put on a map.
inline void add_building(CityModel& city, const std::string& id, const std::vector<Point3d>& ring) {
  city.begin_building(id);
  city.begin_facet(SurfaceKind::unknown, 0);
  city.add_ring(ring);
}

/// A file with one building whose first vertex is `first`, reaching `extent` along both axes, all in the file's own axes.
inline SourceCity source_with(const std::string& crs, const Point3d& first, double extent) {
  SourceCity source;
  source.source = "town.gml";
  source.crs.definition = crs;
  add_building(source.city, "first", {first, first + Point3d{extent, 0, 0}, first + Point3d{0, extent, extent}});
  return source;
}

/// About 10 m of latitude.
inline constexpr double ten_metres_deg = 1e-4;

}  // namespace farlod::georeference
