// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/canopy_sky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "horizon/packet_horizon.hpp"
#include "tests/runtime/canopy/crown_scenes.hpp"

namespace farlod {
namespace {

constexpr CanopyRule all_rules[] = {CanopyRule::once, CanopyRule::each, CanopyRule::beer};
constexpr Looks all_looks[] = {Looks::up, Looks::level, Looks::anywhere};
constexpr std::size_t lanes = ReceiverPacket::lanes;
/// Of sums of floats in blocks of 256 terms of at most 1 + π/2.
constexpr float rounding = 2.6F * 290.0F * 0x1p-24F;

CanopySettings with_rule(CanopyRule rule) { return {rule, Season::leaf_off, 0.6, 0.25}; }

/// Everything that random scenes need.
struct Stage {
  AzimuthSampling azimuths = AzimuthSampling::even(64, GridRotation(Angle::degrees(3.0)));
  CanopySky sky{azimuths};
  RandomPlaces random;
};

// (1) the shares of a receiver depend on its own profile, place and normal, and on the crowns
TEST(CanopySky, SharesDoNotDependOnTheRestOfThePacket) {
  Stage s;
  constexpr int repeats = 20;
  for (int scene = 0; scene < 9 * repeats; ++scene) {
    const CanopyRule rule = all_rules[scene % 3];
    const Looks looks = all_looks[scene / 3 % 3];
    const CrownBatches crowns(some_crowns(s.random, 40, 40.0), with_rule(rule));
    ReceiverPacket receivers = some_receivers(s.random, looks);
    SkyProfile profile = some_profile(s.random, s.azimuths, true);
    const CanopyShares together = s.sky.evaluate(profile, receivers, crowns);
    // The last of them is alone, in all lanes
    constexpr std::size_t last = lanes - 1;
    for (auto* values : {&receivers.x, &receivers.y, &receivers.z, &receivers.normal_x, &receivers.normal_y, &receivers.normal_z})
      values->fill((*values)[last]);
    for (SkyProfile::Rows* rows : {&profile.sky_from, &profile.gap_from, &profile.gap_to, &profile.gap_share})
      for (PacketHorizon::Row& row : *rows) row.fill(row[last]);
    const CanopyShares alone = s.sky.evaluate(profile, receivers, crowns);
    EXPECT_EQ(alone.lost[last], together.lost[last]);
    EXPECT_EQ(alone.behind[last], together.behind[last]);
    EXPECT_EQ(alone.lost[0], together.lost[last]);
  }
}

// Nor on the other packets, for which crowns are culled together
TEST(CanopySky, SharesDoNotDependOnTheRestOfTheGroup) {
  Stage s;
  for (const CanopyRule rule : all_rules)
    for (const Looks looks : all_looks) {
      const CrownBatches crowns(some_crowns(s.random, 90, 40.0), with_rule(rule));
      std::vector<ReceiverPacket> packets;
      std::vector<SkyProfile> profiles;
      for (int n = 0; n < 5; ++n) {
        packets.push_back(some_receivers(s.random, looks));
        profiles.push_back(some_profile(s.random, s.azimuths, n % 2 == 1));
      }
      std::vector<CanopyShares> together(packets.size());
      s.sky.evaluate(profiles, packets, crowns, together);
      for (std::size_t n = 0; n < packets.size(); ++n) {
        const CanopyShares alone = s.sky.evaluate(profiles[n], packets[n], crowns);
        EXPECT_EQ(alone.lost, together[n].lost);
        EXPECT_EQ(alone.behind, together[n].behind);
      }
    }
}

// (2) 0 ≤ lost ≤ behind ≤ the sky of the profile, but for rounding
TEST(CanopySky, SharesAreWithinTheSky) {
  Stage s;
  for (const CanopyRule rule : all_rules)
    for (const Looks looks : all_looks) {
      const CrownBatches crowns(some_crowns(s.random, 60, 20.0), with_rule(rule));
      const ReceiverPacket receivers = some_receivers(s.random, looks);
      const SkyProfile profile = some_profile(s.random, s.azimuths, false);
      PacketHorizon horizon(s.azimuths);
      std::vector<std::uint32_t> bins(s.azimuths.size());
      for (std::uint32_t k = 0; k < bins.size(); ++k) bins[k] = k;
      for (std::size_t l = 0; l < lanes; ++l) {
        std::vector<float> slopes;
        for (const PacketHorizon::Row& row : profile.sky_from) slopes.push_back(row[l]);
        horizon.raise(slopes, only(l), bins);
      }
      const PacketHorizon::Lanes svf = horizon.sky_above(SkyWeight::cosine, receivers);
      const CanopyShares shares = s.sky.evaluate(profile, receivers, crowns);
      for (std::size_t l = 0; l < lanes; ++l) {
        EXPECT_GE(shares.lost[l], 0.0F);
        EXPECT_LE(shares.lost[l], shares.behind[l] + rounding);
        EXPECT_LE(shares.behind[l], svf[l] + rounding);
        EXPECT_GE(shares.svf_total(l, svf[l]), 0.0F);
        EXPECT_LE(shares.svf_total(l, svf[l]), svf[l]);
        EXPECT_EQ(shares.svfveg(l), 1.0F - shares.behind[l]);
      }
    }
}

// (3) a crown more takes no less sky
TEST(CanopySky, ACrownMoreTakesNoLess) {
  Stage s;
  // By the rule `beer`, a new end of a crown moves the nodes of the quadrature
  constexpr float quadrature_error = 2e-4F;
  for (const CanopyRule rule : all_rules)
    for (const Looks looks : all_looks) {
      const std::vector<Crown> crowns = some_crowns(s.random, 30, 15.0);
      const ReceiverPacket receivers = some_receivers(s.random, looks);
      const SkyProfile profile = some_profile(s.random, s.azimuths, true);
      CanopyShares before;
      for (std::size_t count = 1; count <= crowns.size(); ++count) {
        const CanopyShares shares =
            s.sky.evaluate(profile, receivers, CrownBatches(std::span(crowns).first(count), with_rule(rule)));
        for (std::size_t l = 0; l < lanes; ++l) {
          EXPECT_GE(shares.lost[l], before.lost[l] - (rule == CanopyRule::beer ? quadrature_error : rounding));
          EXPECT_GE(shares.behind[l], before.behind[l] - rounding);
        }
        before = shares;
      }
      EXPECT_GT(*std::max_element(before.behind.begin(), before.behind.end()), 0.0F);
    }
}

TEST(CanopySky, WithoutCrownsNothingIsLost) {
  Stage s;
  const CanopyShares shares =
      s.sky.evaluate(SkyProfile(s.azimuths), some_receivers(s.random, Looks::up), CrownBatches({}, CanopySettings{}));
  EXPECT_EQ(shares.lost, PacketHorizon::Lanes{});
  EXPECT_EQ(shares.svf_total(0, 0.7F), 0.7F);
  EXPECT_EQ(shares.svfveg(0), 1.0F);
}

TEST(CanopySky, ForOneCrownTheRulesOnceAndEachAgree) {
  Stage s;
  for (const Looks looks : all_looks)
    for (const Crown& crown : some_crowns(s.random, 30, 10.0)) {
      const ReceiverPacket receivers = some_receivers(s.random, looks);
      const SkyProfile profile = some_profile(s.random, s.azimuths, false);
      const CanopyShares once = s.sky.evaluate(profile, receivers, CrownBatches({&crown, 1}, with_rule(CanopyRule::once))),
                         each = s.sky.evaluate(profile, receivers, CrownBatches({&crown, 1}, with_rule(CanopyRule::each)));
      for (std::size_t l = 0; l < lanes; ++l) {
        EXPECT_NEAR(once.lost[l], each.lost[l], rounding);
        EXPECT_NEAR(once.behind[l], each.behind[l], rounding);
      }
    }
}

TEST(CanopySky, TheSameCrownTwiceCountsOnceOrTwice) {
  Stage s;
  const Crown crown = crown_at(CrownShape::spheroid, {3.0, 0.0}, 2.0, {2.0, 8.0});
  const std::vector<Crown> twins{crown, crown};
  const CanopyShares once = s.sky.evaluate(SkyProfile(s.azimuths), receiver_at_origin(),
                                           CrownBatches(twins, with_rule(CanopyRule::once))),
                     each = s.sky.evaluate(SkyProfile(s.azimuths), receiver_at_origin(),
                                           CrownBatches(twins, with_rule(CanopyRule::each)));
  EXPECT_NEAR(once.lost[0], 0.4F * once.behind[0], rounding);
  EXPECT_NEAR(each.lost[0], (1.0F - 0.36F) * each.behind[0], rounding);
}

TEST(CanopySky, OfSeveralTransmissivitiesTheSmallestCounts) {
  // An evergreen crown, ψ = .03, covers a bare one, and a part of another is seen beside it
  Stage s;
  const std::vector<Crown> crowns{crown_at(CrownShape::cylinder, {}, 3.0, {4.0, 6.0}, Foliage::deciduous),
                                  crown_at(CrownShape::cylinder, {}, 2.0, {4.0, 6.0}, Foliage::evergreen)};
  const CanopyShares shares =
      s.sky.evaluate(SkyProfile(s.azimuths), receiver_at_origin(), CrownBatches(crowns, {CanopyRule::once, Season::leaf_off}));
  const float evergreen = 4.0F / 20.0F, both = 9.0F / 25.0F;
  EXPECT_NEAR(shares.behind[0], both, rounding);
  EXPECT_NEAR(shares.lost[0], 0.97F * evergreen + 0.5F * (both - evergreen), rounding);
}

TEST(CanopySky, CrownsBehindTheHorizonChangeNothing) {
  Stage s;
  const std::vector<Crown> near = some_crowns(s.random, 20, 15.0);
  std::vector<Crown> all = near;
  for (int n = 0; n < 200; ++n) {
    const double azimuth = s.random.between(0.0, 6.28), away_m = s.random.between(60.0, 200.0);
    all.insert(all.begin() + n,
               crown_at(CrownShape::prism, {away_m * std::cos(azimuth), away_m * std::sin(azimuth)}, 2.0, {0.0, 9.0}));
  }
  SkyProfile profile = some_profile(s.random, s.azimuths, false);
  for (PacketHorizon::Row& row : profile.sky_from)
    for (float& slope : row) slope = std::max(slope, 0.3F);
  for (const CanopyRule rule : all_rules) {
    const ReceiverPacket receivers = some_receivers(s.random, Looks::up);
    const CanopyShares with = s.sky.evaluate(profile, receivers, CrownBatches(all, with_rule(rule))),
                       without = s.sky.evaluate(profile, receivers, CrownBatches(near, with_rule(rule)));
    EXPECT_EQ(with.lost, without.lost);
    EXPECT_EQ(with.behind, without.behind);
  }
}

TEST(CanopySky, CrownsOutOfRangeAreNotSeen) {
  // One receiver is 19.5 m from the crown's axis, the other 20.5 m
  Stage s;
  CanopySky within_20_m(s.azimuths, 20.0F);
  for (const CrownShape shape : {CrownShape::spheroid, CrownShape::cylinder, CrownShape::prism})
    for (const CanopyRule rule : all_rules) {
      const std::vector<Crown> crowns{crown_at(shape, {20.0, 0.0}, 4.0, {2.0, 12.0})};
      const ReceiverPacket receivers = packet_of(std::vector<Point3f>{{0.5F, 0.0F, 0.0F}, {-0.5F, 0.0F, 0.0F}});
      const CrownBatches batches(crowns, with_rule(rule));
      const CanopyShares all = s.sky.evaluate(SkyProfile(s.azimuths), receivers, batches),
                         some = within_20_m.evaluate(SkyProfile(s.azimuths), receivers, batches);
      EXPECT_GT(all.lost[1], 0.0F);
      EXPECT_EQ(some.lost[0], all.lost[0]);
      EXPECT_EQ(some.lost[1], 0.0F);
      EXPECT_EQ(some.behind[1], 0.0F);
    }
}

TEST(CanopySky, LosesTheShareOfTheSkyThatJumpsLeave) {
  // Jumps leave half of the sky of each azimuth, in front of the receiver
  Stage s;
  for (const Looks looks : all_looks)
    for (const CanopyRule rule : all_rules) {
      const CrownBatches crowns(some_crowns(s.random, 30, 20.0), with_rule(rule));
      const ReceiverPacket receivers = some_receivers(s.random, looks);
      SkyProfile profile(s.azimuths);
      const CanopyShares all = s.sky.evaluate(profile, receivers, crowns);
      profile.sky.resize(s.azimuths.size());
      static_cast<void>(PacketHorizon(s.azimuths).sky_above(SkyWeight::cosine, receivers, profile.sky));
      for (PacketHorizon::Row& row : profile.sky)
        for (float& sky : row) sky *= 0.5F;
      const CanopyShares half = s.sky.evaluate(profile, receivers, crowns);
      for (std::size_t l = 0; l < lanes; ++l) {
        EXPECT_NEAR(half.lost[l], 0.5F * all.lost[l], rounding);
        EXPECT_NEAR(half.behind[l], 0.5F * all.behind[l], rounding);
      }
    }
}

TEST(CanopySky, TheSkyBehindCrownsIsTheMeanOverAzimuths) {
  Stage s;
  for (const CanopyRule rule : all_rules)
    for (const Looks looks : all_looks) {
      const CrownBatches crowns(some_crowns(s.random, 30, 40.0), with_rule(rule));
      const ReceiverPacket receivers = some_receivers(s.random, looks);
      const SkyProfile profile = some_profile(s.random, s.azimuths, true);
      SkyProfile::Rows behind(s.azimuths.size(), PacketHorizon::Row{{9.0F}});
      const CanopyShares shares = s.sky.evaluate(profile, receivers, crowns, {behind});
      EXPECT_EQ(shares.behind, s.sky.evaluate(profile, receivers, crowns).behind);
      for (std::size_t l = 0; l < lanes; ++l) {
        double sum = 0.0;
        for (const PacketHorizon::Row& row : behind) sum += static_cast<double>(row[l]);
        EXPECT_NEAR(sum / static_cast<double>(s.azimuths.size()), static_cast<double>(shares.behind[l]),
                    static_cast<double>(rounding));
      }
    }
}

TEST(CanopySky, WithoutCrownsInSightNothingIsBehindThem) {
  Stage s;
  SkyProfile::Rows behind(s.azimuths.size(), PacketHorizon::Row{{9.0F}});
  (void)s.sky.evaluate(SkyProfile(s.azimuths), receiver_at_origin(), CrownBatches({}, {}), {behind});
  for (const PacketHorizon::Row& row : behind) EXPECT_EQ(row, PacketHorizon::Row{});
}

TEST(CanopySky, AllTargetsGiveTheSameBits) {
  Stage s;
  for (const CanopyRule rule : all_rules)
    for (const Looks looks : all_looks) {
      const CrownBatches crowns(some_crowns(s.random, 90, 40.0), with_rule(rule));
      const ReceiverPacket receivers = some_receivers(s.random, looks);
      const SkyProfile profile = some_profile(s.random, s.azimuths, true);
      const CanopyShares fastest = s.sky.evaluate(profile, receivers, crowns);
      for (const CrownTarget& target : runnable_crown_kernels()) {
        const CanopyShares shares =
            CanopySky(s.azimuths, std::numeric_limits<float>::infinity(), target).evaluate(profile, receivers, crowns);
        EXPECT_EQ(shares.lost, fastest.lost) << target.name;
        EXPECT_EQ(shares.behind, fastest.behind) << target.name;
      }
    }
}

}  // namespace
}  // namespace farlod
