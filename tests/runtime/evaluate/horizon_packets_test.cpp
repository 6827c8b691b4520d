// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/horizon_packets.hpp"

#include <gtest/gtest.h>

#include "evaluate/visibility.hpp"
#include "farlod/sky/sky_partition.hpp"
#include "tests/contract/far_horizon_by_hand.hpp"

// A wall to the east is near, one to the west is far: once named, once bounded only.

namespace farlod {
namespace {

/// A wall of two triangles at x, from y = −50 m to 70 m.
void add_wall(float x, float height_m, std::vector<Point3f>& vertices, std::vector<Triangle>& triangles) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {{x, -50.0F, 0.0F}, {x, 70.0F, 0.0F}, {x, 70.0F, height_m}, {x, -50.0F, height_m}});
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
}

Occluder walls_at(const std::vector<float>& places) {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (const float x : places) add_wall(x, 30.0F, vertices, triangles);
  return {vertices, triangles};
}

constexpr float near_x = 25.0F, far_x = -40.0F;

class TwoWalls : public testing::TestWithParam<bool> {
 protected:
  TwoWalls()
      : far_(GetParam() ? std::vector<HorizonEdge>{{{far_x, -50.0F, 30.0F}, {far_x, 70.0F, 30.0F}}}
                        : std::vector<HorizonEdge>{}) {
    // Not named, the wall may hide all below 45° anywhere, and surely hides nothing
    std::fill(far_.map().upper.begin(), far_.map().upper.end(), 1.0F);
    std::fill(far_.map().likely.begin(), far_.map().likely.end(), 0.4F);
    for (int n = 0; n < 16; ++n) origins_.push_back({1.0F + 1.2F * static_cast<float>(n), 7.0F, 1.5F});
  }
  [[nodiscard]] std::vector<std::uint32_t> exact() const { return count_free(city_, origins_, directions_); }

  const Occluder near_ = walls_at({near_x}), city_ = walls_at({near_x, far_x});
  const std::vector<Point3d> directions_ = SkyPartition(SkyWeight::cosine, 1000).directions();
  FarHorizonByHand far_;
  std::vector<Point3f> origins_;
};

TEST_P(TwoWalls, TheExactCountLiesWithinTheBounds) {
  HorizonPackets packets(far_.map(), near_, directions_, true);
  const std::vector<FreeRays> free = packets.count(origins_);
  const std::vector<std::uint32_t> truth = exact();
  std::uint32_t open = 0;
  for (std::size_t n = 0; n < free.size(); ++n) {
    EXPECT_LE(free[n].low, free[n].likely);
    EXPECT_LE(free[n].likely, free[n].high);
    EXPECT_LE(free[n].low, truth[n]);
    EXPECT_GE(free[n].high, truth[n]);
    open += free[n].high - free[n].low;
  }
  EXPECT_GT(open, 0U) << "nothing is left open to tell";
}

TEST_P(TwoWalls, SettlingMakesTheDoubtfulExactAndLeavesTheRest) {
  HorizonPackets packets(far_.map(), near_, directions_, true);
  const std::vector<FreeRays> before = packets.count(origins_);
  std::vector<FreeRays> after = before;
  std::vector<bool> doubtful(origins_.size());
  std::uint64_t open = 0;
  for (std::size_t n = 0; n < doubtful.size(); n += 3) {
    doubtful[n] = true;
    open += before[n].high - before[n].low;
  }
  EXPECT_EQ(packets.settle(city_, origins_, doubtful, after), open);
  const std::vector<std::uint32_t> truth = exact();
  for (std::size_t n = 0; n < after.size(); ++n) {
    const FreeRays expected = doubtful[n] ? FreeRays{truth[n], truth[n], truth[n]} : before[n];
    EXPECT_EQ(after[n].low, expected.low) << n;
    EXPECT_EQ(after[n].likely, expected.likely) << n;
    EXPECT_EQ(after[n].high, expected.high) << n;
  }
}

TEST_P(TwoWalls, WithoutBoundsTheLikelyCountIsTheSame) {
  HorizonPackets with(far_.map(), near_, directions_, true), without(far_.map(), near_, directions_, false);
  const std::vector<FreeRays> bounded = with.count(origins_), plain = without.count(origins_);
  for (std::size_t n = 0; n < origins_.size(); ++n) {
    EXPECT_EQ(plain[n].likely, bounded[n].likely);
    EXPECT_EQ(plain[n].low, plain[n].likely);
    EXPECT_EQ(plain[n].high, plain[n].likely);
  }
}

TEST_P(TwoWalls, APacketDoesNotRememberTheOneBefore) {
  HorizonPackets packets(far_.map(), near_, directions_, true);
  const std::vector<FreeRays> all = packets.count(origins_);
  const std::vector<FreeRays> some = packets.count(std::span(origins_).subspan(3, 5));
  for (std::size_t n = 0; n < some.size(); ++n) EXPECT_EQ(some[n].likely, all[n + 3].likely);
}

INSTANTIATE_TEST_SUITE_P(FarWall, TwoWalls, testing::Bool(),
                         [](const auto& test) { return test.param ? "NamedAndBounded" : "Bounded"; });

}  // namespace
}  // namespace farlod
