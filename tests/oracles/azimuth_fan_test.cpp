// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/azimuth_fan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "horizon/sky_partition.hpp"

namespace farlod {
namespace {

constexpr float float_rounding = std::numeric_limits<float>::epsilon();

std::vector<Point3d> directions() { return SkyPartition(SkyWeight::cosine, 290).directions(); }

double pseudo_angle_of(const Point3d& d) { return pseudo_angle({d.x, d.y}); }

/// One after the other, as the definition says.
std::size_t first_by_hand(const AzimuthFan& fan, const std::vector<Point3d>& given, double angle) {
  std::size_t n = 0;
  while (n < fan.size() && pseudo_angle_of(given[fan.place()[n]]) < angle) ++n;
  return n;
}

TEST(AzimuthFan, HoldsEachDirectionOnceInTheOrderOfAzimuths) {
  const std::vector<Point3d> given = directions();
  const AzimuthFan fan(given);
  ASSERT_EQ(fan.size(), given.size());
  EXPECT_EQ(std::set<std::uint32_t>(fan.place().begin(), fan.place().end()).size(), given.size());
  for (std::size_t n = 0; n + 1 < fan.size(); ++n)
    EXPECT_LE(pseudo_angle_of(given[fan.place()[n]]), pseudo_angle_of(given[fan.place()[n + 1]])) << n;
}

TEST(AzimuthFan, KnowsAzimuthAndSlopeOfEach) {
  const std::vector<Point3d> given = directions();
  const AzimuthFan fan(given);
  for (std::size_t n = 0; n < fan.size(); ++n) {
    const Point3d& d = given[fan.place()[n]];
    const double across = std::hypot(d.x, d.y);
    EXPECT_NEAR(fan.cosine()[n], d.x / across, float_rounding);
    EXPECT_NEAR(fan.sine()[n], d.y / across, float_rounding);
    EXPECT_NEAR(fan.slope()[n], d.z / across, d.z / across * float_rounding);
  }
}

TEST(AzimuthFan, StraightUpIsSteeperThanAnything) {
  const std::vector<Point3d> given{{0.6, 0.0, 0.8}, {0.0, 0.0, 1.0}, {-0.6, 0.0, 0.8}};
  const AzimuthFan fan(given);
  const auto up = std::find(fan.place().begin(), fan.place().end(), 1U) - fan.place().begin();
  EXPECT_EQ(fan.slope()[static_cast<std::size_t>(up)], std::numeric_limits<float>::infinity());
  EXPECT_FALSE(std::isnan(fan.cosine()[static_cast<std::size_t>(up)]));
}

TEST(AzimuthFan, FindsTheFirstFromEachDirectionAndBesideIt) {
  const std::vector<Point3d> given = directions();
  const AzimuthFan fan(given);
  std::vector<double> asked{0.0, 4.0, 1.0, 2.0, 3.0};
  for (const Point3d& d : given)
    for (const double to : {0.0, 2.0, 4.0}) {
      asked.push_back(pseudo_angle_of(d));
      asked.push_back(std::nextafter(pseudo_angle_of(d), to));
    }
  for (const double angle : asked) EXPECT_EQ(fan.first_from(angle), first_by_hand(fan, given, angle)) << angle;
}

TEST(AzimuthFan, AtTheEndsOfTheTurn) {
  const std::vector<Point3d> given = directions();
  const AzimuthFan fan(given);
  EXPECT_EQ(fan.first_from(0.0), 0U);
  EXPECT_EQ(fan.first_from(4.0), fan.size());
}

TEST(AzimuthFan, WhereAllLookTheSameWay) {
  const std::vector<Point3d> given(50, Point3d{-0.3, -0.4, 0.5});
  const AzimuthFan fan(given);
  const double angle = pseudo_angle_of(given[0]);
  EXPECT_EQ(fan.first_from(angle), 0U);
  EXPECT_EQ(fan.first_from(std::nextafter(angle, 4.0)), 50U);
}

TEST(AzimuthFan, MayBeEmpty) {
  const AzimuthFan fan({});
  EXPECT_EQ(fan.size(), 0U);
  for (const double angle : {0.0, 1.7, 4.0}) EXPECT_EQ(fan.first_from(angle), 0U);
}

TEST(AzimuthFan, BinsAreThoseOfTheAzimuths) {
  const std::vector<Point3d> given{{1.0, 0.1, 0.5}, {0.1, 1.0, 0.5}, {-1.0, -0.1, 0.5}, {0.1, -1.0, 0.5}};
  const AzimuthFan fan(given);
  EXPECT_EQ(fan.bins({4}), (std::vector<std::uint32_t>{0, 0, 2, 3}));
}

}  // namespace
}  // namespace farlod
