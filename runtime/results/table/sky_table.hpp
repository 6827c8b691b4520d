// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod {

/// A receiver that the user named, with its answer; no answer when it lies inside a building.
struct PointRow {
  std::string id;
  Point2d p_projected;             ///< easting and northing
  std::optional<double> height_m;  ///< where it stands; unknown inside a building
  std::optional<double> svf;
  std::optional<double> low, high;  ///< certain bounds, where asked for
};

/// A receiver on a surface of a building. Azimuth is true (clockwise from true north).
struct SurfacePointRow {
  std::string building;
  std::uint32_t surface = 0;  ///< its number within the building
  SurfaceKind kind = SurfaceKind::unknown;
  Point3d p_projected;
  Angle azimuth, tilt;   ///< of the outward normal; tilt 0° looks up, 90° is a wall
  double area_m2 = 0.0;  ///< the part of the surface that this receiver stands for
  std::optional<double> svf;
  std::optional<double> low, high;  ///< certain bounds, where asked for
};

/// Area-weighted average over the receivers of a surface that have an answer.
struct SurfaceRow {
  std::string building;
  std::uint32_t surface = 0;
  SurfaceKind kind = SurfaceKind::unknown;
  Angle azimuth, tilt;
  double area_m2 = 0.0;
  std::size_t receivers = 0, nodata = 0;
  std::optional<double> svf_mean, svf_min, svf_max;
};

/// Area-weighted averages over the roofs and walls of a building.
struct BuildingRow {
  std::string building;
  double roof_area_m2 = 0.0, wall_area_m2 = 0.0;
  std::size_t receivers = 0, nodata = 0;
  std::optional<double> svf_roofs, svf_walls;
};

}  // namespace farlod
