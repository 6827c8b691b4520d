// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/contract/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/sky_judge.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

namespace farlod {
namespace {

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};
constexpr Point3f up{0.0F, 0.0F, 1.0F};
constexpr std::size_t azimuths = 128;

/// A raster of 1 m over a cell of 20 m, 1.5 m above the ground.
std::vector<Receiver> dense_receivers(const Point3f& normal) {
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < 400; ++n)
    receivers.push_back({n, {0.5F + static_cast<float>(n % 20), 0.5F + static_cast<float>(n / 20), 1.5F}, normal});
  return receivers;
}

/// A town in which horizons are known, and an engine over it.
class KnownTown {
 public:
  KnownTown(const TownByHand& town, SkyWeight weight)
      : hanging_(town.skyline().hanging), skyline_(town.skyline()), engine_(ring_, weight, far_.map(), skyline_, hanging_) {}

  [[nodiscard]] FarHorizon& map() { return far_.map(); }
  [[nodiscard]] const AzimuthRing& ring() const { return ring_; }
  /// Answers receivers packet by packet; the numbers of those that see something hanging.
  std::vector<std::uint32_t> evaluate(std::span<const Receiver> receivers, std::span<BoundedShare> shares) {
    return packet_by_packet(receivers, shares, &HorizonEngine::evaluate);
  }
  std::vector<std::uint32_t> evaluate_with_bounds(std::span<const Receiver> receivers, std::span<BoundedShare> shares) {
    return packet_by_packet(receivers, shares, &HorizonEngine::evaluate_with_bounds);
  }

 private:
  using Evaluate = std::uint32_t (HorizonEngine::*)(const ReceiverPacket&, std::span<BoundedShare>);
  std::vector<std::uint32_t> packet_by_packet(std::span<const Receiver> receivers, std::span<BoundedShare> shares,
                                              Evaluate answer) {
    std::vector<std::uint32_t> see_hanging;
    for (std::uint32_t first = 0; first < receivers.size(); first += ReceiverPacket::lanes) {
      const std::size_t count = std::min(ReceiverPacket::lanes, receivers.size() - first);
      ReceiverPacket packet;
      for (const Receiver& r : receivers.subspan(first, count)) packet.add(r);
      const std::uint32_t bits = (engine_.*answer)(packet, shares.subspan(first, count));
      for (std::uint32_t l = 0; l < count; ++l)
        if (((bits >> l) & 1U) != 0) see_hanging.push_back(first + l);
    }
    return see_hanging;
  }

  AzimuthRing ring_ = AzimuthRing::even(azimuths, {});
  FarHorizonByHand far_{{}};
  HangingCity hanging_;
  CellSkyline skyline_;
  HorizonEngine engine_;
};

TEST(HorizonEngine, AnswersWhatIsAboveTheEdgesOfATown) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 40, town);
  for (const SkyWeight weight : both_weights)
    for (const Point3f& normal : {up, Point3f{0.6F, 0.0F, 0.8F}, {0.0F, -1.0F, 0.0F}, {0.0F, 0.8F, -0.6F}}) {
      KnownTown known(town, weight);
      const std::vector<Receiver> receivers = receivers_in_a_square(random, normal);
      std::vector<BoundedShare> shares(receivers.size());
      EXPECT_TRUE(known.evaluate(receivers, shares).empty());
      for (const Receiver& r : receivers) {
        const auto sky_above = [&](double SlopeRange::*end) {
          return judged_sky(weight, normal, known.ring(), [&](std::size_t k) {
            return judged_horizon(town.standing(), r.p_cell, {known.ring().cosine()[k], known.ring().sine()[k]}).*end;
          });
        };
        const double rounding = sky_rounding(azimuths, normal);
        EXPECT_LE(shares[r.index].likely, sky_above(&SlopeRange::low) + rounding) << r.index;
        EXPECT_GE(shares[r.index].likely, sky_above(&SlopeRange::high) - rounding) << r.index;
      }
    }
}

TEST(HorizonEngine, AReceiverSeesTheSameWhoeverStandsBesideIt) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 40, town);
  for (const Point3f& normal : {up, Point3f{0.6F, 0.0F, 0.8F}}) {
    KnownTown known(town, SkyWeight::cosine);
    const std::vector<Receiver> receivers = dense_receivers(normal);
    std::vector<BoundedShare> together(receivers.size()), with_bounds(receivers.size()), alone(1);
    EXPECT_TRUE(known.evaluate(receivers, together).empty());
    EXPECT_TRUE(known.evaluate_with_bounds(receivers, with_bounds).empty());
    for (std::size_t n = 0; n < receivers.size(); ++n) {
      EXPECT_TRUE(known.evaluate(std::span(receivers).subspan(n, 1), alone).empty());
      EXPECT_EQ(alone[0].likely, together[n].likely) << n;
      EXPECT_EQ(with_bounds[n].likely, together[n].likely) << n;
    }
  }
}

TEST(HorizonEngine, WhatIsLikelyChangesEvenlyFromFloorToFloor) {
  KnownTown known(TownByHand(), SkyWeight::cosine);
  FarHorizon& map = known.map();
  // Each bin has its own
  for (std::size_t n = 0; n < map.likely.size(); ++n)
    map.likely[n] = (n < map.bins.count ? 1.0F : 0.5F) + 0.1F * static_cast<float>(n % map.bins.count);
  std::fill(map.upper.begin(), map.upper.end(), 2.0F);
  // Floors at 0 and 10 m; below the lowest nobody knows: as on it
  for (const float z : {-3.0F, 0.0F, 2.5F, 5.0F, 7.5F, 10.0F, 99.0F}) {
    const std::vector<Receiver> receiver{{0, {3.0F, 3.0F, z}}};
    std::vector<BoundedShare> share(1);
    known.evaluate(receiver, share);
    const double between = 1.0 - 0.05 * double{std::clamp(z, 0.0F, 10.0F)};
    const double expected = judged_sky(SkyWeight::cosine, up, known.ring(), [&](std::size_t k) {
      return between + 0.1 * map.bins.bin_of({known.ring().cosine()[k], known.ring().sine()[k]});
    });
    EXPECT_NEAR(share[0].likely, expected, sky_rounding(azimuths, up)) << z << " m";
  }
}

TEST(HorizonEngine, ReceiversOfOnePacketMayStandOnDifferentFloors) {
  KnownTown known(TownByHand(), SkyWeight::cosine);
  FarHorizon& map = known.map();
  for (std::size_t n = 0; n < map.likely.size(); ++n) {
    map.lower[n] = n < map.bins.count ? 0.5F : 0.0F;
    map.likely[n] = n < map.bins.count ? 1.0F : 0.25F;
    map.upper[n] = n < map.bins.count ? 2.0F : 0.5F;
  }
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < 11; ++n) receivers.push_back({n, {3.0F, 3.0F, -7.0F + 2.0F * static_cast<float>(n)}});
  std::vector<BoundedShare> together(receivers.size()), alone(1);
  known.evaluate_with_bounds(receivers, together);
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    known.evaluate_with_bounds(std::span(receivers).subspan(n, 1), alone);
    EXPECT_EQ(alone[0].low, together[n].low) << n;
    EXPECT_EQ(alone[0].likely, together[n].likely) << n;
    EXPECT_EQ(alone[0].high, together[n].high) << n;
  }
  // Below the lowest floor nothing is certain
  EXPECT_EQ(together.front().low, 0.0F);
  EXPECT_EQ(together.front().high, 1.0F);
}

TEST(HorizonEngine, BoundsHoldWhatIsLikely) {
  RandomPlaces random;
  TownByHand town;
  add_random_boxes(random, 20, town);
  KnownTown known(town, SkyWeight::cosine);
  std::fill(known.map().lower.begin(), known.map().lower.end(), 0.2F);
  std::fill(known.map().likely.begin(), known.map().likely.end(), 0.5F);
  std::fill(known.map().upper.begin(), known.map().upper.end(), 0.9F);
  const std::vector<Receiver> receivers = receivers_in_a_square(random, up);
  std::vector<BoundedShare> bounded(receivers.size()), plain(receivers.size());
  known.evaluate_with_bounds(receivers, bounded);
  known.evaluate(receivers, plain);
  for (const Receiver& r : receivers) {
    const BoundedShare& share = bounded[r.index];
    EXPECT_EQ(share.likely, plain[r.index].likely);
    const auto sky_above = [&](double unnamed) {
      return judged_sky(SkyWeight::cosine, up, known.ring(), [&](std::size_t k) {
        const Point2d u{known.ring().cosine()[k], known.ring().sine()[k]};
        return std::max(unnamed, judged_horizon(town.standing(), r.p_cell, u).high);
      });
    };
    // Where an edge ends within rounding of an azimuth, that azimuth's share may differ
    const double tolerance = sky_rounding(azimuths, up) + 1.0 / azimuths;
    EXPECT_NEAR(share.high, sky_above(0.2F), tolerance);
    EXPECT_NEAR(share.likely, sky_above(0.5F), tolerance);
    EXPECT_NEAR(share.low, sky_above(0.9F), tolerance);
    EXPECT_LT(share.low, share.likely);
    EXPECT_LT(share.likely, share.high);
  }
}

/// Whether something hangs over a receiver's horizon; neither when rounding may decide.
struct Hangs {
  bool surely = false, surely_not = true;
};
Hangs hangs_over(const TownByHand& town, const AzimuthRing& ring, const Point3f& p) {
  Hangs result;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point2d u{ring.cosine()[k], ring.sine()[k]};
    const SlopeRange standing = judged_horizon(town.standing(), p, u), outline = judged_horizon(town.outlines(), p, u);
    result.surely = result.surely || outline.low > standing.high;
    result.surely_not = result.surely_not && outline.high < std::max(standing.low, std::numeric_limits<double>::min());
  }
  return result;
}

class WhatHangs : public testing::TestWithParam<std::size_t> {};

TEST_P(WhatHangs, IsSeenByThoseWhoHaveItOverTheirHorizon) {
  // A row of houses in the east hides a slab behind it from those who stand near to the row
  TownByHand town;
  town.add_box({22.0, -60.0}, {4.0, 140.0}, 12.0);
  town.add_slab({40.0, 5.0}, {5.0, 9.0}, 22.0);
  KnownTown known(town, SkyWeight::cosine);
  std::vector<Receiver> receivers = dense_receivers(up);
  receivers.resize(GetParam());
  std::vector<BoundedShare> shares(receivers.size());
  const std::vector<std::uint32_t> seen = known.evaluate(receivers, shares);
  int see_it = 0, see_nothing = 0;
  for (std::uint32_t n = 0; n < receivers.size(); ++n) {
    const Hangs hangs = hangs_over(town, known.ring(), receivers[n].p_cell);
    const auto times = std::count(seen.begin(), seen.end(), n);
    EXPECT_LE(times, 1);
    EXPECT_TRUE(times == 1 || !hangs.surely) << n;
    EXPECT_TRUE(times == 0 || !hangs.surely_not) << n;
    see_it += hangs.surely ? 1 : 0;
    see_nothing += hangs.surely_not ? 1 : 0;
  }
  if (receivers.size() > 16) {
    EXPECT_GT(std::min(see_it, see_nothing), 20) << "too few to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(HorizonEngine, WhatHangs, testing::Values(3U, 16U, 400U));

TEST(HorizonEngine, ASlabRightOverheadIsSeen) {
  TownByHand town;
  town.add_slab({5.0, 5.0}, {4.0, 4.0}, 6.0);
  // Walls all around so near and high that no outline shows over them but from below
  town.add_box({3.0, 3.0}, {0.5, 8.0}, 60.0);
  town.add_box({10.5, 3.0}, {0.5, 8.0}, 60.0);
  town.add_box({3.0, 10.5}, {8.0, 0.5}, 60.0);
  town.add_box({3.0, 3.0}, {8.0, 0.5}, 60.0);
  KnownTown known(town, SkyWeight::cosine);
  const std::vector<Receiver> receivers{{0, {7.0F, 7.0F, 1.5F}}, {1, {15.0F, 15.0F, 1.5F}}};
  std::vector<BoundedShare> shares(2);
  EXPECT_EQ(known.evaluate(receivers, shares), std::vector<std::uint32_t>{0});
  EXPECT_EQ(known.evaluate_with_bounds(receivers, shares), std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace farlod
