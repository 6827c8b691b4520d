// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "base/frame.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/point.hpp"
#include "horizon/sky_partition.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The directions in which a receiver looks, in the grid frame. They are fixed in the city frame, so that turning the grid
/// changes no receiver's directions.
class SkyDirections {
 public:
  /// Throws Cancelled when `stop` is asked for: millions of directions take a second.
  SkyDirections(SkyWeight weight, std::size_t ray_count, const GridRotation& rotation, DirectionSet set = DirectionSet::partition,
                const std::stop_token& stop = {});

  /// Number of rays of the hemisphere, above the horizon or below it: the denominator of a view factor.
  [[nodiscard]] std::size_t ray_count() const { return local_.size(); }
  /// The directions of a receiver whose normal points straight up: all rays, all above the horizon.
  [[nodiscard]] std::span<const Point3d> facing_up() const { return facing_up_; }
  /// The directions of a receiver with this normal (length 1, grid frame): those of its rays that point above the horizon.
  [[nodiscard]] std::vector<Point3d> facing(const Point3d& normal) const;
  /// Those of a receiver.
  [[nodiscard]] std::vector<Point3d> facing_as(const Receiver& receiver) const {
    const Point3f& n = receiver.normal;
    return n == Point3f{0.0F, 0.0F, 1.0F} ? facing_up_ : facing(normalized(Point3d{n.x, n.y, n.z}));
  }

 private:
  std::vector<Point3d> local_;  ///< around the receiver's own axis
  std::vector<Point3d> facing_up_;
};

}  // namespace farlod
