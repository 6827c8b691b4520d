// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "farlod/point.hpp"
#include "farlod/surfaces.hpp"

namespace farlod {

/// A receiver that the user named, with its answer; no answer when it lies inside a building.
struct PointRow {
  std::string id;
  Point2d p_projected;             ///< easting and northing
  std::optional<double> height_m;  ///< where it stands; unknown inside a building
  std::optional<double> svf;
  std::optional<double> low, high;  ///< certain bounds, where asked for
  /// Where it looks, clockwise from true north and from straight up; none: straight up.
  std::optional<double> azimuth_deg = {}, tilt_deg = {};
  std::span<const float> further = {};  ///< as many as AnswerColumns::further; NaN where there is no answer
};

}  // namespace farlod
