// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/azimuth_ring.hpp"

namespace farlod {

/// Directions above the horizontal, in the order of their azimuths.
class RayFan {
 public:
  explicit RayFan(std::span<const Point3d> directions) : ring_(AzimuthRing::of(directions)) {
    for (const std::uint32_t n : ring_.place()) {
      const Point3d& d = directions[n];
      directions_.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
      slopes_.push_back(static_cast<float>(d.z / std::hypot(d.x, d.y)));
    }
  }

  [[nodiscard]] std::size_t size() const { return directions_.size(); }
  [[nodiscard]] const AzimuthRing& ring() const { return ring_; }
  [[nodiscard]] const Point3f& direction(std::size_t k) const { return directions_[k]; }
  /// The tangents of the directions' elevations; infinite straight up.
  [[nodiscard]] std::span<const float> slopes() const { return slopes_; }

 private:
  AzimuthRing ring_;
  std::vector<Point3f> directions_;
  std::vector<float> slopes_;
};

}  // namespace farlod
