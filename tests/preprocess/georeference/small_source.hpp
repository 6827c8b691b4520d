// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "georeference/georeference.hpp"

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

/// Easting, northing and height of the first vertex of a building.
inline Point3d first_projected(const LocatedCity& located, std::size_t building = 0) {
  const Point2d origin = located.georeference.origin_m;
  return located.city.points_of(located.city.buildings()[building])[0] + Point3d{origin.x, origin.y, 0.0};
}

inline void expect_place(const Point3d& p, const Point3d& expected, double tolerance_m) {
  EXPECT_NEAR(p.x, expected.x, tolerance_m);
  EXPECT_NEAR(p.y, expected.y, tolerance_m);
  EXPECT_NEAR(p.z, expected.z, tolerance_m);
}

/// About 10 m of latitude.
inline constexpr double ten_metres_deg = 1e-4;

}  // namespace farlod::georeference
