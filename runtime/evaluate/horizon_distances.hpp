// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// Where a receiver's values have its horizons and their distances: from `elevations` and `distances` on, one for each direction.
struct HorizonColumns {
  std::size_t elevations = 0, distances = 0;
  std::vector<Point2d> directions_grid = {};  ///< of length 1; empty where no distances are asked for
};

/// Fills the distances of a receiver whose horizons are known: level ones, in metres, to what is met nearest just below the
/// horizon. NaN where the horizon is level ground, and where nothing is met within two degrees below it. `origin` is the place of
/// the receiver in a scene of the whole city.
void trace_horizon_distances(const Occluder& city, const Point3f& origin, const HorizonColumns& columns, std::span<float> values);

}  // namespace farlod
