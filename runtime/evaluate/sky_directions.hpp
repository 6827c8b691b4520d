// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "farlod/frame.hpp"
#include "farlod/point.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// Where in the sky rays go.
enum class DirectionSet {
  partition,  ///< one ray in each cell of the Beckers & Beckers partition (SkyPartition), as in the paper
  fibonacci   ///< a spherical Fibonacci lattice with the sky's weight: fixed, of low discrepancy
};

/// The directions in which a receiver looks, in the grid frame. They are fixed in the city frame, so that turning the grid
/// changes no receiver's directions.
class SkyDirections {
 public:
  SkyDirections(SkyWeight weight, std::size_t ray_count, const GridRotation& rotation,
                DirectionSet set = DirectionSet::partition);

  /// All rays of the hemisphere, whether or not they reach the sky: what a view factor is a share of.
  [[nodiscard]] std::size_t ray_count() const { return local_.size(); }
  /// For a horizontal receiver: all rays, all above the horizon.
  [[nodiscard]] std::span<const Point3d> horizontal() const { return horizontal_; }
  /// For a receiver with this normal (length 1, grid frame): those of its rays that point above the horizon.
  [[nodiscard]] std::vector<Point3d> around(const Point3d& normal) const;

 private:
  std::vector<Point3d> local_;  ///< around the receiver's own axis
  std::vector<Point3d> horizontal_;
};

}  // namespace farlod
