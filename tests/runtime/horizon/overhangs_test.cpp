// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/overhangs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/runtime/horizon/grazing_rays.hpp"
#include "tests/runtime/horizon/packed_overhangs.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

namespace farlod {
namespace {

using TriangleCorners = OverhangGeometry::TriangleCorners;

/// A receiver this near to the outline of a triangle may count as below it or not.
constexpr double border_m = 0.003;

/// How far inside of a triangle's outline a place lies, seen from above; negative outside of it.
double depth_inside(const TriangleCorners& t, const Point3f& p) {
  double least = 1e9, area = 0.0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3f &a = t[n], &b = t[(n + 1) % 3];
    area += double{a.x} * b.y - double{b.x} * a.y;
  }
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3f &a = t[n], &b = t[(n + 1) % 3];
    const Point2d along{double{b.x} - a.x, double{b.y} - a.y}, to{double{p.x} - a.x, double{p.y} - a.y};
    const double left = (along.x * to.y - along.y * to.x) / norm(along);
    least = std::min(least, area > 0.0 ? left : -left);
  }
  return least;
}

std::vector<TriangleCorners> random_triangles(RandomPlaces& random, int count) {
  std::vector<TriangleCorners> triangles;
  for (int n = 0; n < count; ++n) {
    const Point3f a = random.place(30.0, 3.0, 20.0);
    const auto beside = [&] {
      return Point3f{a.x + random.between(-8.0, 8.0), a.y + random.between(-8.0, 8.0), a.z + random.between(-2.0, 2.0)};
    };
    const Point3f b = beside();
    triangles.push_back({a, b, beside()});
  }
  return triangles;
}

std::vector<Point3f> random_eyes(RandomPlaces& random) {
  const Point3f low = random.place(25.0, 0.0, 8.0);
  std::vector<Point3f> eyes;
  for (int n = 0; n < 16; ++n)
    eyes.push_back({low.x + random.between(0.0, 6.0), low.y + random.between(0.0, 6.0), low.z + random.between(0.0, 3.0)});
  return eyes;
}

TEST(OverhangGeometry, CoversThoseWhoStandBelow) {
  RandomPlaces random;
  int below = 0, beside = 0;
  for (int n = 0; n < 200; ++n) {
    const std::vector<TriangleCorners> triangles = random_triangles(random, 4);
    const std::vector<Point3f> eyes = random_eyes(random);
    const std::uint32_t bits = PackedOverhangs(triangles).geometry().receivers_below(packet_of(eyes));
    for (std::size_t l = 0; l < eyes.size(); ++l) {
      bool must = false, may = false;
      for (const TriangleCorners& t : triangles) {
        const double depth = depth_inside(t, eyes[l]);
        const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
        must = must || (depth > border_m && low > eyes[l].z);
        may = may || (depth > -border_m && high > eyes[l].z);
      }
      const bool is_covered = ((bits >> l) & 1U) != 0;
      EXPECT_TRUE(is_covered || !must) << n << ", " << l;
      EXPECT_TRUE(may || !is_covered) << n << ", " << l;
      below += must ? 1 : 0;
      beside += may ? 0 : 1;
    }
  }
  EXPECT_GT(std::min(below, beside), 50) << "too few to tell";
}

TEST(OverhangGeometry, AVerticalWallCoversNobodyBesideIt) {
  const std::vector<TriangleCorners> wall{{{{5.0F, 0.0F, 2.0F}, {5.0F, 8.0F, 2.0F}, {5.0F, 8.0F, 9.0F}}}};
  const std::vector<Point3f> eyes{{4.9F, 4.0F, 1.0F}, {5.1F, 4.0F, 1.0F}};
  EXPECT_EQ(PackedOverhangs(wall).geometry().receivers_below(packet_of(eyes)), 0U);
}

/// The roles of edges by their definition, ray by ray: above the upper borders all is free, and between the highest lower border
/// and the highest upper one all is hidden.
TEST(OverhangGeometry, RaysMeetWhatFloatsBelowItsUpperBordersAndAboveTheLowerOnes) {
  RandomPlaces random;
  const DirectionSampling sampling(SkyPartition(SkyWeight::solid_angle, 500).directions());
  std::size_t free_above = 0, hidden_between = 0, open = 0;
  for (int n = 0; n < 300; ++n) {
    TownByHand town;
    for (const TriangleCorners& t : random_triangles(random, 1 + n % 3)) town.add_floating(t);
    const PackedOverhangs packed(town.overhanging());
    OverhangGeometry overhangs = packed.geometry();
    const std::vector<Point3f> eyes = random_eyes(random);
    const ReceiverPacket packet = packet_of(eyes);
    PacketHorizon upper(sampling.azimuths()), lower(sampling.azimuths());
    upper.raise(town.silhouettes().near.overhangs, packet);
    upper.close(overhangs.receivers_below(packet));
    lower.raise(town.silhouettes().near.undersides, packet);
    for (std::size_t l = 0; l < eyes.size(); ++l)
      for (std::size_t k = 0; k < sampling.size(); ++k) {
        const RayVerdict ray = verdict(overhangs.scene().occluder, eyes[l], sampling.direction(k));
        const bool is_above_upper = ((upper.below(k, sampling.slopes()[k]) >> l) & 1U) != 0;
        const bool is_above_lower = ((lower.below(k, sampling.slopes()[k]) >> l) & 1U) != 0;
        ++(is_above_upper ? free_above : is_above_lower ? hidden_between : open);
        if (ray.grazes || !(is_above_upper || is_above_lower)) continue;
        EXPECT_EQ(ray.is_free, is_above_upper) << n << ", receiver " << l << ", ray " << k;
      }
  }
  EXPECT_GT(std::min({free_above, hidden_between, open}), 500U) << "too few to tell";
}

TEST(OverhangGeometry, ItsSceneIsWhatOverhangsAlone) {
  RandomPlaces random;
  const std::vector<TriangleCorners> triangles = random_triangles(random, 7);
  const PackedOverhangs packed(triangles);
  OverhangGeometry overhangs = packed.geometry();
  EXPECT_EQ(overhangs.scene().occluder.triangle_count(), 7U);
  EXPECT_EQ(&overhangs.scene().occluder, &overhangs.scene().occluder) << "it is made once";
}

TEST(OverhangGeometry, NothingHangsFromNothing) {
  const PackedOverhangs packed({});
  OverhangGeometry none = packed.geometry();
  EXPECT_EQ(none.scene().occluder.triangle_count(), 0U);
  const std::vector<Point3f> eyes{{5.0F, 5.0F, 1.0F}};
  EXPECT_EQ(none.receivers_below(packet_of(eyes)), 0U);
}

}  // namespace
}  // namespace farlod
