// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "farlod/point.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {

/// Rings without their first corner repeated: the shell counter-clockwise, holes clockwise.
struct ZonePolygon {
  std::vector<Point2d> shell;
  std::vector<std::vector<Point2d>> holes;
};

/// The polygons of a file, in the CRS of the package. Each feature takes the place of a cell.
struct RequestedZones {
  std::vector<std::vector<ZonePolygon>> zones;
  Attributes attributes;  ///< a row for each zone
};

}  // namespace farlod
