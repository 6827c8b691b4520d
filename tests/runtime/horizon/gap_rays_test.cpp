// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_rays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stop_token>
#include <vector>

#include "base/cancellation.hpp"
#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "occlusion/occluder.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

/// A wall without thickness from one height up to another one, all around the middle of the cell, as a square of 40 m.
Occluder fence(float low_m, float high_m) {
  const std::array<std::array<float, 2>, 4> plan{{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}};
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t n = 0; n < 4; ++n) {
    const auto [px, py] = plan[n];
    const auto [qx, qy] = plan[(n + 1) % 4];
    vertices.insert(vertices.end(), {{px, py, low_m}, {qx, qy, low_m}, {qx, qy, high_m}, {px, py, high_m}});
    triangles.push_back({4 * n, 4 * n + 1, 4 * n + 2});
    triangles.push_back({4 * n, 4 * n + 2, 4 * n + 3});
  }
  return {vertices, triangles};
}

/// From a receiver to the side of the square that an azimuth meets first.
double distance_to_fence(const ReceiverPacket& packet, std::size_t lane, double cosine, double sine) {
  return std::min((cosine > 0.0 ? 20.0 - packet.x[lane] : 20.0 + packet.x[lane]) / std::abs(cosine),
                  (sine > 0.0 ? 20.0 - packet.y[lane] : 20.0 + packet.y[lane]) / std::abs(sine));
}

constexpr std::size_t azimuths = 96;
constexpr std::uint32_t all_receivers = 0xFFFF;
constexpr Point3f normals[] = {{0.0F, 0.0F, 1.0F}, {0.6F, 0.0F, 0.8F}, {0.0F, -1.0F, 0.0F}, {0.0F, 0.8F, -0.6F}};

/// Gaps between horizons that differ from azimuth to azimuth and from bin to bin; in every fifth azimuth there is none.
class GapRays : public testing::Test {
 protected:
  GapRays() {
    std::vector<std::uint32_t> each(azimuths);
    std::vector<float> low(azimuths), high(azimuths);
    for (std::uint32_t k = 0; k < azimuths; ++k) {
      each[k] = k;
      low[k] = 0.05F * static_cast<float>(k % 7);
      high[k] = k % 5 == 0 ? low[k] : low[k] + 0.1F + 0.02F * static_cast<float>(k % 11);
    }
    from_.raise(low, everybody, each);
    to_.raise(high, everybody, each);
  }
  [[nodiscard]] ReceiverPacket receivers(const Point3f& normal) const {
    std::vector<Point3f> places;
    for (int n = 0; n < 16; ++n) places.push_back({static_cast<float>(n % 4) - 2.0F, static_cast<float>(n / 4) - 2.0F, 1.5F});
    return packet_of(places, normal);
  }
  [[nodiscard]] PacketHorizon::Lanes traced(const Occluder& scene, SkyWeight weight, const ReceiverPacket& packet,
                                            std::uint32_t wanted = all_receivers, std::size_t rays = 4) {
    from_.find_sky_below(to_, weight, packet, sky_);
    // Nothing fills the gaps
    return trace_gaps({from_, to_, to_, to_, sky_}, ring_, weight, packet, wanted, rays, {scene, {}}).sky;
  }
  [[nodiscard]] double sum_of_sky(std::size_t lane) const {
    double sum = 0.0;
    for (const PacketHorizon::Row& row : sky_) sum += row[lane];
    return sum;
  }

  const AzimuthSampling ring_ = AzimuthSampling::even(azimuths, {});
  PacketHorizon from_{ring_}, to_{ring_};
  std::vector<PacketHorizon::Row> sky_;
};

TEST_F(GapRays, WhereNothingIsMetAllOfTheGapsIsSeen) {
  const Occluder nothing({}, {});
  for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle})
    for (const Point3f& normal : normals)
      for (const std::size_t rays : {1U, 4U, 9U}) {
        const ReceiverPacket packet = receivers(normal);
        const PacketHorizon::Lanes seen = traced(nothing, weight, packet, all_receivers, rays);
        // Each part of a gap is a difference of its own
        const double rounding = static_cast<double>(2 * rays) * sky_rounding(azimuths, normal);
        for (std::size_t l = 0; l < seen.size(); ++l) {
          EXPECT_NEAR(seen[l], sum_of_sky(l), 2.0 * rounding) << rays << " rays, receiver " << l;
          EXPECT_NEAR(seen[l], from_.sky_above(weight, packet)[l] - to_.sky_above(weight, packet)[l], 2.0 * rounding);
        }
      }
}

TEST_F(GapRays, WhereAllIsHiddenNothingIsSeen) {
  const ReceiverPacket packet = receivers(normals[0]);
  for (const float sky : traced(fence(-50.0F, 200.0F), SkyWeight::cosine, packet)) EXPECT_EQ(sky, 0.0F);
}

TEST_F(GapRays, WhatIsFilledIsNotSeen) {
  const ReceiverPacket packet = receivers(normals[0]);
  from_.find_sky_below(to_, SkyWeight::cosine, packet, sky_);
  const Occluder nothing({}, {});
  const Gaps filled{from_, to_, from_, to_, sky_};
  for (const float sky : trace_gaps(filled, ring_, SkyWeight::cosine, packet, all_receivers, 4, {nothing, {}}).sky)
    EXPECT_EQ(sky, 0.0F);
}

TEST_F(GapRays, AStopEndsTheTracing) {
  const ReceiverPacket packet = receivers(normals[0]);
  from_.find_sky_below(to_, SkyWeight::cosine, packet, sky_);
  const Occluder nothing({}, {});
  std::stop_source stop;
  stop.request_stop();
  const Gaps gaps{from_, to_, to_, to_, sky_};
  EXPECT_THROW((void)trace_gaps(gaps, ring_, SkyWeight::cosine, packet, all_receivers, 4, {nothing, {}}, stop.get_token()),
               Cancelled);
}

TEST_F(GapRays, OnlyThoseAreAskedWhoAreMeant) {
  constexpr std::uint32_t wanted = 0b1010'0000'0001'0110;
  const ReceiverPacket packet = receivers(normals[0]);
  const PacketHorizon::Lanes all = traced(Occluder({}, {}), SkyWeight::cosine, packet),
                             some = traced(Occluder({}, {}), SkyWeight::cosine, packet, wanted);
  for (std::size_t l = 0; l < all.size(); ++l) EXPECT_EQ(some[l], ((wanted >> l) & 1U) != 0 ? all[l] : 0.0F) << l;
}

TEST_F(GapRays, WhatIsMetIsHiddenToTheWidthOfARay) {
  // The fence hides the slopes above where it begins: each azimuth's gap is cut once, and errs by one of its parts at the most
  const Occluder scene = fence(4.5F, 200.0F);
  const ReceiverPacket packet = receivers(normals[0]);
  double error_before = 1.0;
  for (const std::size_t rays : {8U, 32U, 128U, 512U}) {
    const PacketHorizon::Lanes seen = traced(scene, SkyWeight::cosine, packet, all_receivers, rays);
    double largest = 0.0;
    for (std::size_t l = 0; l < seen.size(); ++l) {
      double truth = 0.0, one_part = 0.0;
      for (std::size_t k = 0; k < azimuths; ++k) {
        const double c = ring_.cosine()[k], s = ring_.sine()[k];
        const double distance = distance_to_fence(packet, l, c, s);
        const double low = from_.row(k)[l], high = to_.row(k)[l], foot = std::clamp(3.0 / distance, low, high);
        const auto sky_above = [](double slope) { return 1.0 / (1.0 + slope * slope) / static_cast<double>(azimuths); };
        truth += sky_above(low) - sky_above(foot);
        // ray_count: the share of the azimuth's sky that the widest gap takes, at least one ray
        const double sky = sky_above(low) - sky_above(high);
        one_part += sky / std::max(1.0, sky * static_cast<double>(azimuths) * static_cast<double>(rays));
      }
      EXPECT_NEAR(seen[l], truth, one_part + sky_rounding(azimuths, normals[0])) << rays << " rays, receiver " << l;
      largest = std::max(largest, std::abs(seen[l] - truth));
    }
    EXPECT_LT(largest, error_before);
    error_before = largest;
  }
  // Offsets differ from azimuth to azimuth: errors of single azimuths have either sign
  EXPECT_LT(error_before, 1e-4);
}

TEST(SmallestGaps, NoMoreAreRemovedThanAsked) {
  std::vector<PacketHorizon::Row> sky(5);
  const std::array sizes{0.004F, 0.001F, 0.0F, 0.002F, 0.001F};
  for (std::size_t k = 0; k < sky.size(); ++k) sky[k][3] = sky[k][4] = sizes[k];
  EXPECT_FLOAT_EQ(remove_smallest_gaps(sky, 3, 0.0035F), 0.002F);
  const std::array left{0.004F, 0.0F, 0.0F, 0.002F, 0.0F};
  for (std::size_t k = 0; k < sky.size(); ++k) {
    EXPECT_EQ(sky[k][3], left[k]);
    EXPECT_EQ(sky[k][4], sizes[k]) << "another receiver's";
  }
  EXPECT_FLOAT_EQ(remove_smallest_gaps(sky, 4, 0.0015F), 0.001F) << "one of the two smallest";
  EXPECT_FLOAT_EQ(remove_smallest_gaps(sky, 4, 1.0F), 0.007F);
  EXPECT_EQ(remove_smallest_gaps(sky, 4, 1.0F), 0.0F);
}

}  // namespace
}  // namespace farlod
