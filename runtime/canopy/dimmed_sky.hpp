// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace farlod {

/// Slopes at an azimuth at which crowns take a share of the light that comes to a receiver, if there is sky.
struct DimmedSlopes {
  std::uint32_t azimuth = 0, lane = 0;
  float low = 0.0F, high = 0.0F;
  float lost = 0.0F;
};
/// All of the receivers of a packet. Of slopes that overlap, shares add up.
using DimmedSky = std::vector<DimmedSlopes>;

/// Appends what some has of the lanes of these bits.
inline void append_lanes(const DimmedSky& some, std::uint32_t lanes, DimmedSky& all) {
  for (const DimmedSlopes& slopes : some)
    if ((lanes >> slopes.lane & 1U) != 0) all.push_back(slopes);
}

/// What kernels tell of dimmed slopes: rows of their ends and of the shares lost, for the lanes of these bits. A null `lost`
/// stands for 1. Nobody asks where `take` is null.
struct DimmedTaker {
  void* to = nullptr;
  void (*take)(void* to, std::uint32_t azimuth, std::uint32_t lanes, const float* low, const float* high,
               const float* lost) = nullptr;
};

/// Keeps what a kernel tells of some lanes, `share` of it.
struct KeepDimmed {
  DimmedSky& sky;
  float share = 1.0F;
  std::uint32_t wanted = 0;  ///< bits of the lanes

  [[nodiscard]] DimmedTaker taker() { return {this, take}; }

 private:
  static void take(void* to, std::uint32_t azimuth, std::uint32_t lanes, const float* low, const float* high, const float* lost) {
    KeepDimmed& keep = *static_cast<KeepDimmed*>(to);
    for (std::uint32_t left = lanes & keep.wanted; left != 0; left &= left - 1) {
      const auto l = static_cast<std::uint32_t>(std::countr_zero(left));
      keep.sky.push_back({azimuth, l, low[l], high[l], lost == nullptr ? keep.share : keep.share * lost[l]});
    }
  }
};

}  // namespace farlod
