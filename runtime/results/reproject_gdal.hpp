// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// Takes points from a CRS that the user names ("EPSG:4326", WKT, …) into another one. In both, x is the easting or the
/// longitude and y the northing or the latitude, whatever axis order the CRS declares. Degrees stay degrees.
/// Throws PointsError when a CRS is not known or a point cannot be projected; it names the point by its number from 1.
[[nodiscard]] std::vector<Point2d> reprojected(std::span<const Point2d> points, const std::string& from_crs,
                                               const std::string& to_crs);

}  // namespace farlod
