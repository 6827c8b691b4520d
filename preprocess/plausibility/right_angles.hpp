// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "city/city_model.hpp"

namespace farlod::plausibility {

/// How many corners of outlines are right angles. In degrees, corners of buildings are right at one latitude alone, since a
/// degree of longitude is shorter than one of latitude by its cosine: so they tell which of two coordinates is the latitude.
struct RightAngles {
  std::size_t corners = 0;
  std::size_t as_read = 0;     ///< right angles with x as the longitude and y as the latitude
  std::size_t exchanged = 0;   ///< right angles with y as the longitude and x as the latitude
  std::size_t in_degrees = 0;  ///< right angles as drawn in degrees

  /// Whether longitude and latitude are exchanged beyond doubt:
  ///   (1) there are 80 corners and more, as ten houses have on floor and roof
  ///   (2) half of them at least are right when exchanged, and at most half as many as they are read
  ///   (3) fewer than nine tenths as many are right in degrees, as those of a town that was drawn on a map of degrees are
  [[nodiscard]] bool speak_for_exchange() const;
};

/// The corners between two sides of 4 m and more; `city` has longitude, latitude and any height. Where a longitude is no
/// latitude, a corner does not count.
[[nodiscard]] RightAngles right_angles_of(const CityModel& city);

}  // namespace farlod::plausibility
