// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/residual_horizon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/package/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

/// Two floors, at 0 and 10 m: slopes differ from floor to floor, and from bin to bin.
class TwoFloors : public testing::Test {
 protected:
  TwoFloors() {
    FarHorizon& map = far_.map();
    for (std::size_t n = 0; n < map.estimate.size(); ++n) {
      map.low[n] = 0.2F * slope_of(n);
      map.estimate[n] = slope_of(n);
      map.high[n] = 2.0F * slope_of(n);
      map.overhang[n] = 0.5F * slope_of(n);
    }
  }
  [[nodiscard]] float slope_of(std::size_t row) const { return (row < 8 ? 1.0F : 0.75F) + 0.0625F * static_cast<float>(row % 8); }

  using Raise = void (ResidualHorizon::*)(const ReceiverPacket&, PacketHorizon&) const;
  /// Whether the horizon of each receiver, once raised, lies at slope_at(place, bin), within a few roundings.
  template <class SlopeAt>
  void expect_slopes(const std::vector<Point3f>& places, Raise raise, const SlopeAt& slope_at) {
    PacketHorizon horizon(ring_);
    (ResidualHorizon(far_.map(), ring_).*raise)(packet_of(places), horizon);
    constexpr auto rounding = static_cast<float>(8.0 * float_rounding);
    for (std::size_t l = 0; l < places.size(); ++l)
      for (std::size_t k = 0; k < ring_.size(); ++k) {
        const float slope = slope_at(places[l], far_.map().bins.bin_of({ring_.cosine()[k], ring_.sine()[k]}));
        EXPECT_EQ((horizon.below(k, slope * (1.0F - rounding)) >> l) & 1U, 0U) << places[l].z << " m, azimuth " << k;
        EXPECT_EQ((horizon.below(k, slope * (1.0F + rounding) + rounding) >> l) & 1U, std::isinf(slope) ? 0U : 1U) << places[l].z;
      }
  }
  static std::vector<Point3f> at_heights(const std::vector<float>& heights_m) {
    std::vector<Point3f> places;
    for (const float z : heights_m) places.push_back({3.0F, 3.0F, z});
    return places;
  }

  FarHorizonByHand far_{{}};
  const AzimuthSampling ring_ = AzimuthSampling::even(40, {});
  const std::vector<std::vector<float>> alike_and_not_{{2.5F},  {2.5F, 2.5F, 2.5F},          {1.0F, 9.0F, 3.0F},
                                                       {-2.0F}, {0.0F, 10.0F, 50.0F, -1.0F}, {9.9F, 10.1F}};
};

TEST_F(TwoFloors, TheEstimateChangesEvenlyBetweenThem) {
  for (const auto& heights_m : alike_and_not_)
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_estimate, [this](const Point3f& p, std::uint32_t bin) {
      const float share = std::clamp(p.z / 10.0F, 0.0F, 1.0F);
      return slope_of(bin) + share * (slope_of(8 + bin) - slope_of(bin));
    });
}

TEST_F(TwoFloors, BoundsHoldForAFloor) {
  for (const auto& heights_m : alike_and_not_) {
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_low, [this](const Point3f& p, std::uint32_t bin) {
      return p.z < 0.0F ? 0.0F : 0.2F * slope_of(p.z < 10.0F ? bin : 8 + bin);
    });
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_high, [this](const Point3f& p, std::uint32_t bin) {
      return p.z < 0.0F ? std::numeric_limits<float>::infinity() : 2.0F * slope_of(p.z < 10.0F ? bin : 8 + bin);
    });
  }
}

TEST_F(TwoFloors, LowerBordersRiseToWhatHoldsForAFloor) {
  for (const auto& heights_m : alike_and_not_)
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_overhang, [this](const Point3f& p, std::uint32_t bin) {
      return p.z < 0.0F ? std::numeric_limits<float>::infinity() : 0.5F * slope_of(p.z < 10.0F ? bin : 8 + bin);
    });
}

TEST_F(TwoFloors, WhereNothingOverhangsNoBorderRises) {
  std::fill(far_.map().overhang.begin(), far_.map().overhang.end(), 0.0F);
  for (const auto& heights_m : alike_and_not_)
    expect_slopes(at_heights(heights_m), &ResidualHorizon::raise_to_overhang, [](const Point3f&, std::uint32_t) { return 0.0F; });
}

TEST_F(TwoFloors, TheEstimateStaysBetweenTheBounds) {
  std::fill(far_.map().estimate.begin(), far_.map().estimate.begin() + 8, 9.0F);
  std::fill(far_.map().estimate.begin() + 8, far_.map().estimate.end(), 0.0F);
  expect_slopes(at_heights({1.0F, 2.0F}), &ResidualHorizon::raise_to_estimate,
                [this](const Point3f&, std::uint32_t bin) { return 2.0F * slope_of(bin); });
  expect_slopes(at_heights({12.0F}), &ResidualHorizon::raise_to_estimate,
                [this](const Point3f&, std::uint32_t bin) { return 0.2F * slope_of(8 + bin); });
}

}  // namespace
}  // namespace farlod
