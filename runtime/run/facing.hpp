// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/angle.hpp"
#include "farlod/point.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// Where a receiver looks, as people say it.
struct Facing {
  Angle azimuth;  ///< clockwise from true north; 0 where the receiver looks straight up or down
  Angle tilt;     ///< 0 looks straight up, 90° level, 180° straight down
};

/// The facing of a normal of length 1. Its azimuth lies in [0°, 360°).
[[nodiscard]] Facing facing_of(const Point3d& normal_grid, const package::Manifest& manifest);

/// The normal of a facing: facing_of(normal_of(f)) == f up to rounding. Its length is 1; a tilt of 0 gives exactly (0, 0, 1).
[[nodiscard]] Point3d normal_of(const Facing& facing, const package::Manifest& manifest);

}  // namespace farlod
