// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "inputs/attributes.hpp"

namespace farlod {

/// A file of points cannot be read or used. The message names the file and the place in it, says what is wrong, and what to do.
class PointsError : public InputError {
 public:
  using InputError::InputError;
};

/// Where a point looks, in degrees as in files.
struct RequestedNormal {
  double azimuth_deg = 0.0;  ///< clockwise from true north, −360 to 360
  double tilt_deg = 0.0;     ///< 0 looks straight up, 90 level; 0 to 180
};

/// A point whose sky the user wants to know, in the CRS of the file.
struct RequestedPoint {
  std::string id;           ///< as the file says, or the number of the point from 1
  double x = 0.0, y = 0.0;  ///< easting and northing, or longitude and latitude
  std::optional<double> z;
  std::optional<RequestedNormal> normal;  ///< none: it looks straight up
};

/// The points of a file.
struct RequestedPoints {
  std::vector<RequestedPoint> points;
  Attributes attributes;                    ///< a row for each point
  bool has_normals = false;                 ///< the file has fields for them, even if they are empty
  std::optional<std::string> crs_wkt = {};  ///< as the file says; empty: it says none; absent: it is a table, which never does
  std::size_t skipped_features = 0;         ///< of the file, which are no points
  std::vector<std::string> notes;           ///< what the user should know of how the file was read, a sentence each
};

/// The normal of two fields, of which an empty one has no number: none where both are empty; a tilt of 0 needs no azimuth.
/// Where the two are no normal, `refuse` is called with what is wrong; it throws.
template <class Refuse>
[[nodiscard]] std::optional<RequestedNormal> normal_of(std::optional<double> azimuth_deg, std::optional<double> tilt_deg,
                                                       const Refuse& refuse) {
  if (!azimuth_deg && !tilt_deg) return std::nullopt;
  if (!tilt_deg) refuse("there is an azimuth and no tilt; give both, or neither to let the point look straight up");
  if (!(0.0 <= *tilt_deg && *tilt_deg <= 180.0)) refuse("the tilt is not between 0 (straight up) and 180 degrees");
  if (!azimuth_deg && *tilt_deg > 0.0) refuse("there is a tilt and no azimuth; give both, or a tilt of 0");
  const double azimuth = azimuth_deg.value_or(0.0);
  if (!(-360.0 <= azimuth && azimuth <= 360.0)) refuse("the azimuth is not between -360 and 360 degrees");
  return RequestedNormal{azimuth, *tilt_deg};
}

}  // namespace farlod
