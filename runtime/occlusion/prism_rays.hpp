// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "occlusion/occluder.hpp"
#include "package/crown.hpp"

namespace farlod {

/// The rays of a packet, as upright prisms see them that are turned alike: those of a canopy raster all are. What their divisions
/// have in common is done once.
class PrismRays {
 public:
  static constexpr std::size_t lanes = RayOrigins::lanes;

  /// The turn is that of the prism.
  PrismRays(const RayOrigins& origins, const Occluder::Directions& directions, const Crown& prism)
      : turn_(prism.turn), cosine_(std::cos(prism.turn_rad())), sine_(std::sin(prism.turn_rad())) {
    const double c = cosine_, s = sine_;
    for (std::size_t l = 0; l < lanes; ++l) {
      const double x = origins.x[l], y = origins.y[l], dx = directions.x[l], dy = directions.y[l];
      x_[l] = c * x + s * y;
      y_[l] = c * y - s * x;
      z_[l] = origins.z[l];
      per_x_[l] = 1.0 / (c * dx + s * dy);
      per_y_[l] = 1.0 / (c * dy - s * dx);
      per_z_[l] = 1.0 / static_cast<double>(directions.z[l]);
      has_finite_ = has_finite_ && std::isfinite(per_x_[l]) && std::isfinite(per_y_[l]) && std::isfinite(per_z_[l]);
    }
  }
  /// Whether they see this crown: no ray runs along a side of it.
  [[nodiscard]] bool see(const Crown& crown) const {
    return crown.shape == CrownShape::prism && crown.turn == turn_ && has_finite_;
  }
  /// Bits of the rays that meet such a crown between their begins and ends; one that only touches it does not.
  [[nodiscard]] std::uint32_t meet(const Crown& crown, const float* begins, const float* ends) const {
    const double half_m = crown.half_width_m, bottom_m = crown.bottom_m, top_m = crown.top_m;
    const double x = cosine_ * crown.x_m + sine_ * crown.y_m, y = cosine_ * crown.y_m - sine_ * crown.x_m;
    alignas(64) std::array<double, lanes> near, far;
    for (std::size_t l = 0; l < lanes; ++l) near[l] = begins[l];
    for (std::size_t l = 0; l < lanes; ++l) far[l] = ends[l];
    cut(x_, per_x_, x - half_m, x + half_m, near, far);
    cut(y_, per_y_, y - half_m, y + half_m, near, far);
    cut(z_, per_z_, bottom_m, top_m, near, far);
    std::uint32_t met = 0;
    for (std::size_t l = 0; l < lanes; ++l) met |= near[l] < far[l] ? 1U << l : 0U;
    return met;
  }

 private:
  using Lanes = std::array<double, lanes>;

  /// Keeps what lies between two planes.
  static void cut(const Lanes& origins, const Lanes& per, double low, double high, Lanes& near, Lanes& far) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const double a = (low - origins[l]) * per[l], b = (high - origins[l]) * per[l];
      const double first = a < b ? a : b, last = a < b ? b : a;
      near[l] = near[l] < first ? first : near[l];
      far[l] = last < far[l] ? last : far[l];
    }
  }

  std::uint16_t turn_;
  double cosine_, sine_;
  bool has_finite_ = true;
  alignas(64) Lanes x_{}, y_{}, z_{}, per_x_{}, per_y_{}, per_z_{};
};

}  // namespace farlod
