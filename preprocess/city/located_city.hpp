// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "city/source.hpp"
#include "farlod/angle.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// Where the city frame lies on the Earth.
struct Georeference {
  std::string crs_wkt;      ///< the output CRS: projected, in metres
  std::optional<int> epsg;  ///< its code, where it has one
  std::string crs_name;     ///< for people
  Point2d origin_m;         ///< easting and northing of the city frame's origin
  /// Meridian convergence γ at the origin: true azimuth = grid azimuth + γ.
  Angle convergence;
};

/// A city in the city frame: metres, x along the output CRS's easting, y along its northing, minus the origin.
struct LocatedCity {
  CityModel city;
  Georeference georeference;
  std::vector<std::string> sources = {};               ///< names of the files, for messages
  std::vector<Point3d> relief_points = {};             ///< points of the ground that the files give as terrain
  std::vector<std::optional<PlacedFile>> placed = {};  ///< of the sources: empty where attributes have no places
};

}  // namespace farlod
