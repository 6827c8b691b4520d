// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/far_map/far_horizon.hpp"
#include "farlod/far_map/far_view.hpp"
#include "farlod/sky/azimuth_fan.hpp"
#include "occlusion/occluder.hpp"

namespace farlod {

/// Of a receiver's rays, how many reach the sky: at the least, likely, and at the most.
struct FreeRays {
  std::uint32_t low = 0, likely = 0, high = 0;
};

/// Counts free rays for packets of receivers that look in the same directions: what the far map settles is not traced, the
/// rest meets the near scene.
class HorizonPackets {
 public:
  /// The map and the scene must outlive it. Without `wants_bounds`, what is likely blocked is not traced either, and low = high
  /// = likely.
  HorizonPackets(const FarHorizon& far, const Occluder& near, std::vector<Point3d> directions, bool wants_bounds);

  /// For up to `origins_per_packet` receivers (cell frame).
  [[nodiscard]] std::vector<FreeRays> count(std::span<const Point3f> origins_cell);

  /// Traces what the far map left open for the doubtful among the receivers that were counted last, against everything;
  /// `origins` are the same receivers in the frame of `city`. Needs `wants_bounds`. Returns the number of rays.
  std::uint64_t settle(const Occluder& city, std::span<const Point3f> origins, const std::vector<bool>& doubtful,
                       std::vector<FreeRays>& free);

 private:
  [[nodiscard]] FarVerdict& verdict(std::size_t fan_place, std::size_t origin) {
    return verdicts_[fan_place * origin_count_ + origin];
  }

  const Occluder& near_;
  bool wants_bounds_;
  std::vector<Point3d> directions_;  ///< in the order of the fan
  AzimuthFan fan_;
  FarView view_;
  std::size_t origin_count_ = 0;
  std::vector<FarVerdict> verdicts_;  ///< a row of origins for each direction
  std::vector<std::uint8_t> wanted_, free_;
};

}  // namespace farlod
