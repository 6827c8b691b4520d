// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "inputs/requested_points.hpp"

namespace farlod {

/// Reads points from a table whose columns are separated by commas, semicolons or tabs.
///   (1) With a header row, columns are found by name, in capitals or not: id, name, fid; x, x_m, easting, lon, longitude;
///       y, y_m, northing, lat, latitude; z, z_m, height_m, elevation; azimuth, azimuth_deg and tilt, tilt_deg.
///   (2) Without one, the columns are x, y and perhaps z.
///   (3) Fields may be quoted (RFC 4180); a byte order mark, CRLF and empty lines do no harm; an empty z is no z.
///   (4) All columns but `id`, coordinates and normals are attributes.
///   (5) Rows that cannot be read are left out and told, up to one in ten.
/// Throws PointsError.
[[nodiscard]] RequestedPoints read_points_csv(const std::filesystem::path& path);

/// The names of the columns of a table, of which only the first line is read; none where it is no header row. Throws PointsError.
[[nodiscard]] std::vector<std::string> read_header_csv(const std::filesystem::path& path);

/// Reads all columns of a table with a header row, of any content: (3) holds. Throws PointsError.
[[nodiscard]] Attributes read_table_csv(const std::filesystem::path& path);

}  // namespace farlod
