// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/point.hpp"

namespace farlod::georeference {

enum class AxisOrder { easting_first, northing_first };

/// How the coordinates of a file differ from those on the map of its CRS, where x is the easting or longitude, y the northing or
/// latitude, and z is in metres.
struct FileAxes {
  AxisOrder order = AxisOrder::easting_first;
  double before_easting = 0.0;  ///< added to each easting by the file: 32,000,000 if it begins with the zone 32
  double height_unit_m = 1.0;

  bool operator==(const FileAxes&) const = default;

  [[nodiscard]] Point3d p_map(const Point3d& p_file) const {
    const bool swap = order == AxisOrder::northing_first;
    return {(swap ? p_file.y : p_file.x) - before_easting, swap ? p_file.x : p_file.y, p_file.z * height_unit_m};
  }
  [[nodiscard]] Point3d p_file(const Point3d& p_map) const {
    const Point2d p{p_map.x + before_easting, p_map.y};
    const bool swap = order == AxisOrder::northing_first;
    return {swap ? p.y : p.x, swap ? p.x : p.y, p_map.z / height_unit_m};
  }
};

}  // namespace farlod::georeference
