// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "points/requested_points.hpp"

namespace farlod {

/// Reads points from a table whose columns are separated by commas, semicolons or tabs.
///   (1) With a header row, columns are found by name, in capitals or not: id, name, fid; x, x_m, easting, lon, longitude;
///       y, y_m, northing, lat, latitude; z, z_m, height_m, elevation; azimuth, azimuth_deg and tilt, tilt_deg.
///   (2) Without one, the columns are x, y and perhaps z.
///   (3) Fields may be quoted (RFC 4180); a byte order mark, CRLF and empty lines do no harm; an empty z is no z.
///   (4) All columns but `id`, coordinates and normals are attributes.
/// Throws PointsError.
[[nodiscard]] RequestedPoints read_points_csv(const std::filesystem::path& path);

}  // namespace farlod
