// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "occlusion/crown_occluder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "farlod/error.hpp"
#include "package/crown.hpp"
#include "tests/runtime/canopy/crowns_by_hand.hpp"
#include "tests/runtime/canopy/ray_in_crown.hpp"
#include "tests/runtime/occlusion/random_rays.hpp"

namespace farlod {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t all_lanes = 0xFFFF;

// One ray

constexpr Point3f up{0.0F, 0.0F, 1.0F}, east{1.0F, 0.0F, 0.0F};
const Crown tree = crown_at(CrownShape::cylinder, {0.0, 0.0}, 3.0, {4.0, 10.0});

TEST(CrownOccluder, NothingHidesNothing) {
  const CrownOccluder nothing({}, {});
  EXPECT_EQ(nothing.crown_count(), 0U);
  EXPECT_EQ(nothing.light({{}, up}).transmitted, 1.0F);
  EXPECT_FALSE(nothing.light({{}, up}).is_met());
  const CrownLights lights = nothing.light(RayOrigins{}, up, 0.0F, all_lanes);
  EXPECT_EQ(lights.met, 0U);
  EXPECT_EQ(lights.transmitted[7], 1.0F);
  EXPECT_EQ(nothing.met_before({}, RayOrigins{}, Occluder::Directions{}, 0.0F, all_lanes), 0U);
}

TEST(CrownOccluder, EachRuleHasItsLight) {
  const Crown above = crown_at(CrownShape::spheroid, {0.0, 0.0}, 1.0, {12.0, 14.0}, Foliage::evergreen);
  const auto light = [&](const CanopySettings& settings) {
    return CrownOccluder({tree, above}, settings).light({{}, up}).transmitted;
  };
  EXPECT_FLOAT_EQ(light(settings_of(CanopyRule::once, 0.2)), 0.2F);
  EXPECT_FLOAT_EQ(light(settings_of(CanopyRule::each, 0.2)), 0.04F);
  EXPECT_FLOAT_EQ(light(settings_of(CanopyRule::beer, {}, 0.1)), static_cast<float>(std::exp(-0.8)));
  // In winter, the evergreen one has the smaller share
  EXPECT_FLOAT_EQ(light(settings_of(CanopyRule::once, 0.4, 0.1, Season::leaf_off)), 0.03F);
  EXPECT_FLOAT_EQ(light(settings_of(CanopyRule::each, 0.4, 0.1, Season::leaf_off)), 0.012F);
  const double bare = 0.1 * std::log(0.5) / std::log(0.03);
  EXPECT_FLOAT_EQ(light(settings_of(CanopyRule::beer, {}, 0.1, Season::leaf_off)),
                  static_cast<float>(std::exp(-6.0 * bare - 0.2)));
}

TEST(CrownOccluder, TheNearestEntryCountsInTheLengthOfTheDirection) {
  const CrownOccluder occluder({tree, crown_at(CrownShape::prism, {0.0, 0.0}, 1.0, {2.0, 3.0})}, {});
  EXPECT_FLOAT_EQ(occluder.light({{}, up}).nearest, 2.0F);
  EXPECT_FLOAT_EQ(occluder.light({{}, {0.0F, 0.0F, 4.0F}}).nearest, 0.5F);
  EXPECT_FLOAT_EQ(occluder.light({{2.0F, 0.0F, 0.0F}, up}).nearest, 4.0F);
  EXPECT_FALSE(occluder.light({{4.0F, 0.0F, 0.0F}, up}).is_met());
  EXPECT_FALSE(occluder.light({{0.0F, 0.0F, 11.0F}, up}).is_met());
}

TEST(CrownOccluder, ARayCountsFromItsBeginToItsEnd) {
  const CrownOccluder occluder({tree}, settings_of(CanopyRule::beer, {}, 0.1));
  const auto depth = [&](const Ray& ray) { return -10.0F * std::log(occluder.light(ray).transmitted); };
  // Twice the rounding of a share to a float, over κ
  constexpr float tolerance_m = 2e-6F;
  EXPECT_NEAR(depth({{}, up}), 6.0F, tolerance_m);
  EXPECT_NEAR(depth({{0.0F, 0.0F, 5.0F}, up}), 5.0F, tolerance_m);
  EXPECT_NEAR(depth({{}, up, 8.0F}), 2.0F, tolerance_m);
  EXPECT_NEAR(depth({{}, up, 0.0F, 7.0F}), 3.0F, tolerance_m);
  EXPECT_NEAR(depth({{0.0F, 0.0F, 5.0F}, east}), 3.0F, tolerance_m);
  EXPECT_NEAR(depth({{0.0F, 0.0F, 5.0F}, {2.0F, 0.0F, 0.0F}}), 3.0F, tolerance_m);
  EXPECT_EQ(occluder.light({{0.0F, 0.0F, 5.0F}, up}).nearest, 0.0F);
  EXPECT_EQ(occluder.light({{}, up, 8.0F}).nearest, 8.0F);
  EXPECT_FALSE(occluder.light({{}, up, 0.0F, 3.0F}).is_met());
  EXPECT_FALSE(occluder.light({{}, up, 10.5F}).is_met());
}

TEST(CrownOccluder, ARayThatTouchesDoesNotMeet) {
  const CrownOccluder occluder({tree, crown_at(CrownShape::prism, {10.0, 0.0}, 1.0, {4.0, 10.0})}, {});
  for (const float x : {3.0F, -3.0F, 9.0F, 11.0F}) EXPECT_FALSE(occluder.light({{x, 0.0F, 0.0F}, up}).is_met()) << x;
  for (const float z : {4.0F, 10.0F}) EXPECT_FALSE(occluder.light({{-20.0F, 0.0F, z}, east}).is_met()) << z;
}

TEST(CrownOccluder, ASquareIsTurnedCounterClockwise) {
  // By atan(1/2): the corner (1, 1) comes to lie at (1, 3)/√5
  const auto turn = static_cast<std::uint16_t>(std::lround(std::atan(0.5) / (std::numbers::pi / 2.0) * 65536.0));
  const CrownOccluder occluder({crown_at(CrownShape::prism, {0.0, 0.0}, 1.0, {1.0, 2.0}, Foliage::unknown, turn)}, {});
  const auto is_met = [&](double x, double y) {
    return occluder.light({{static_cast<float>(x), static_cast<float>(y), 0.0F}, up}).is_met();
  };
  const double r = 1.0 / std::sqrt(5.0);
  for (const double share : {0.99, 1.01}) {
    EXPECT_EQ(is_met(share * r, share * 3.0 * r), share < 1.0);
    EXPECT_EQ(is_met(-share * 3.0 * r, share * r), share < 1.0);
    EXPECT_EQ(is_met(share * 2.0 * r, share * r), share < 1.0);
  }
}

TEST(CrownOccluder, LightAloneIsTheSameLight) {
  const CrownOccluder occluder({tree, crown_at(CrownShape::spheroid, {0.0, 0.0}, 1.0, {12.0, 14.0}, Foliage::evergreen)},
                               settings_of(CanopyRule::once, 0.4, 0.1, Season::leaf_off));
  for (const float x : {0.0F, 2.0F, 5.0F}) {
    const Ray ray{{x, 0.0F, 0.0F}, up};
    EXPECT_EQ(occluder.light(ray, CrownQuestion::light).transmitted, occluder.light(ray).transmitted);
    EXPECT_EQ(occluder.light(ray, CrownQuestion::light).is_met(), occluder.light(ray).is_met());
  }
}

TEST(CrownOccluder, AStoppedBuildIsCancelled) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(CrownOccluder({tree}, {}, stop.get_token()), Cancelled);
}

// Against an independent judge: one body after the other

struct Judgement {
  double transmitted = 1.0, nearest = infinity;
};

Judgement judged(const std::vector<Crown>& crowns, const CanopySettings& settings, const Ray& ray) {
  double least = 1.0, product = 1.0, depth = 0.0, nearest = infinity;
  const Point3d origin{ray.origin.x, ray.origin.y, ray.origin.z}, direction{ray.direction.x, ray.direction.y, ray.direction.z};
  for (const Crown& crown : crowns) {
    const auto [begin, end] = common_part(part_in_crown(crown, origin, direction), {ray.begin, ray.end});
    if (begin >= end) continue;
    least = std::min(least, transmissivity_of(crown.foliage, settings));
    product *= transmissivity_of(crown.foliage, settings);
    depth += extinction_per_m_of(crown.foliage, settings) * (end - begin) * norm(direction);
    nearest = std::min(nearest, begin);
  }
  const double by_rule[] = {least, product, std::exp(-depth)};
  return {by_rule[static_cast<std::size_t>(settings.rule)], nearest};
}

class RandomCrowns : public RandomRays {
 protected:
  std::vector<Crown> crowns(std::size_t count) {
    std::vector<Crown> result;
    for (std::size_t n = 0; n < count; ++n) {
      const double bottom_m = 20.0 * double{random()};
      result.push_back(crown_at(static_cast<CrownShape>(n % 3), {40.0 * double{random()}, 40.0 * double{random()}},
                                4.0 + 3.5 * double{random()}, {bottom_m, bottom_m + 6.0 + 5.0 * double{random()}},
                                static_cast<Foliage>(random_() % 3),
                                static_cast<std::uint16_t>(n % 3 == 2 ? random_() & 0xFFFFU : 0U)));
    }
    return result;
  }
  Ray ray() {
    Ray ray{point(45.0F), point(2.0F)};
    if (random() < -0.5F) ray.begin = 5.0F + 5.0F * random();
    if (random() < -0.5F) ray.end = 25.0F + 10.0F * random();
    return ray;
  }
};

/// All numbers are computed in double, and rounded to a float once. Where a ray grazes a body, or begins far from it, some digits
/// of the double are lost: a tenth of what a float has is never reached.
constexpr double tolerance = 1.1 * 0x1p-24;

TEST_F(RandomCrowns, LightIsThatOfTheJudge) {
  const std::vector<Crown> all = crowns(400);
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::each, CanopyRule::beer})
    for (const Season season : {Season::leaf_on, Season::leaf_off}) {
      const CanopySettings settings = settings_of(rule, 0.6, 0.02, season);
      const CrownOccluder occluder(all, settings);
      std::size_t met = 0, began_within = 0;
      for (int n = 0; n < 4000; ++n) {
        const Ray asked = ray();
        const Judgement expected = judged(all, settings, asked);
        const CrownLight light = occluder.light(asked);
        ASSERT_NEAR(light.transmitted, expected.transmitted, tolerance) << n;
        ASSERT_EQ(light.is_met(), expected.nearest < infinity) << n;
        ASSERT_EQ(occluder.light(asked, CrownQuestion::light).transmitted, light.transmitted) << n;
        if (!light.is_met()) continue;
        ASSERT_NEAR(light.nearest, expected.nearest, tolerance * std::max(1.0, expected.nearest)) << n;
        ++met;
        began_within += light.nearest == asked.begin ? 1U : 0U;
      }
      EXPECT_TRUE(met > 1000 && met < 3900 && began_within > 100) << met << ' ' << began_within;
    }
}

TEST_F(RandomCrowns, PacketsAnswerAsSingleRaysDo) {
  const std::vector<Crown> all = crowns(300);
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::each, CanopyRule::beer}) {
    const CrownOccluder occluder(all, settings_of(rule, 0.6, 0.02));
    for (std::uint32_t n = 0; n < 600; ++n) {
      const std::uint32_t wanted = n % 3 == 0 ? all_lanes : (n * 2654435761U) >> 16;
      const CrownQuestion question = n % 2 == 0 ? CrownQuestion::light : CrownQuestion::light_and_nearest;
      const Point3f shared = point(1.0F), corner = point(40.0F);
      constexpr float begin = 2.0F;
      RayPacket packet;
      std::array<Ray, RayOrigins::lanes> rays;
      for (std::size_t l = 0; l < rays.size(); ++l) {
        rays[l] = {corner + point(4.0F), point(1.0F), begin};
        packet.set(l, rays[l]);
      }
      const CrownLights lights = occluder.light(packet.origins, packet.directions, begin, wanted, question);
      const CrownLights lights_shared = occluder.light(packet.origins, shared, begin, wanted, question);
      for (std::size_t l = 0; l < rays.size(); ++l) {
        const bool is_wanted = ((wanted >> l) & 1U) != 0;
        const CrownLight single = is_wanted ? occluder.light(rays[l], question) : CrownLight{};
        const CrownLight single_shared = is_wanted ? occluder.light({rays[l].origin, shared, begin}, question) : CrownLight{};
        ASSERT_EQ(lights.transmitted[l], single.transmitted);
        ASSERT_EQ(lights_shared.transmitted[l], single_shared.transmitted);
        ASSERT_EQ(((lights.met >> l) & 1U) != 0, single.is_met());
        if (question == CrownQuestion::light) continue;
        ASSERT_EQ(lights.nearest[l], single.nearest);
        ASSERT_EQ(lights_shared.nearest[l], single_shared.nearest);
      }
    }
  }
}

TEST_F(RandomCrowns, RaysThatEndMeetTheirCrownsBefore) {
  const CrownOccluder occluder(crowns(300), settings_of(CanopyRule::each, 0.6, 0.02));
  std::size_t met = 0, ended = 0;
  for (std::uint32_t n = 0; n < 600; ++n) {
    const std::uint32_t wanted = n % 3 == 0 ? all_lanes : (n * 2654435761U) >> 16;
    const Point3f corner = point(40.0F);
    constexpr float begin = 2.0F;
    RayPacket packet;
    Occluder::Distances ends;
    std::uint32_t expected = 0;
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
      const Ray one{corner + point(4.0F), point(1.0F), begin, 40.0F + 39.0F * random()};
      packet.set(l, one);
      ends[l] = l == 0 ? std::numeric_limits<float>::infinity() : one.end;
      const bool is_met = occluder.light({one.origin, one.direction, begin, ends[l]}).is_met();
      expected |= is_met ? 1U << l : 0U;
      met += is_met ? 1U : 0U;
      ended += !is_met && occluder.light({one.origin, one.direction, begin}).is_met() ? 1U : 0U;
    }
    ASSERT_EQ(occluder.met_before(ends, packet.origins, packet.directions, begin, wanted), expected & wanted) << n;
  }
  EXPECT_TRUE(met > 1000 && ended > 500) << met << ' ' << ended;
}

}  // namespace
}  // namespace farlod
