// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/point.hpp"

namespace farlod::georeference {

enum class AxisOrder { easting_first, northing_first };

/// How a file counts, against the map of its CRS: x the easting or longitude, y the northing or latitude, z in metres.
struct FileAxes {
  AxisOrder order = AxisOrder::easting_first;
  double before_easting = 0.0;  ///< what the file adds to each easting: 32,000,000 where it begins with the zone
  double height_unit_m = 1.0;

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
