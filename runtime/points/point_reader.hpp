// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farlod/error.hpp"

namespace farlod {

/// A list of points cannot be read or used. The message names the file and the line, says what is wrong, and what to do.
class PointsError : public InputError {
 public:
  using InputError::InputError;
};

/// A point whose sky the user wants to know, in the CRS of the file.
struct RequestedPoint {
  std::string id;           ///< as the file says, or the number of the point from 1
  double x = 0.0, y = 0.0;  ///< easting and northing, or longitude and latitude
  std::optional<double> z;
};

/// Reads points from a table whose columns are separated by commas, semicolons or tabs.
///   (1) With a header row, columns are found by name, in capitals or not: id, name, fid; x, x_m, easting, lon, longitude;
///       y, y_m, northing, lat, latitude; z, z_m, height_m, elevation. Other columns are ignored.
///   (2) Without one, the columns are x, y and perhaps z.
///   (3) Fields may be quoted (RFC 4180); a byte order mark, CRLF and empty lines do no harm; an empty z is no z.
/// Throws PointsError.
[[nodiscard]] std::vector<RequestedPoint> read_points_csv(const std::filesystem::path& path);

}  // namespace farlod
