// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "occlusion/occluder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "occlusion/placed_mesh.hpp"
#include "tests/runtime/occlusion/random_rays.hpp"

namespace farlod {
namespace {

constexpr Point3f upwards{0.0F, 0.0F, 1.0F}, down{0.0F, 0.0F, -1.0F};

/// Horizontal triangles around the z axis, one at each height.
Occluder layers(const std::vector<float>& heights_m) {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (const float z : heights_m) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {{-2.0F, -1.0F, z}, {2.0F, -1.0F, z}, {0.0F, 3.0F, z}});
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

TEST(Occluder, BlocksWhatMeetsATriangleFromEitherSide) {
  const Occluder occluder = layers({1.0F, 2.0F});
  EXPECT_EQ(occluder.triangle_count(), 2U);
  EXPECT_TRUE(occluder.blocks({{0.1F, 0.2F, 0.0F}, upwards}));
  EXPECT_TRUE(occluder.blocks({{0.1F, 0.2F, 3.0F}, down}));
  EXPECT_TRUE(occluder.blocks({{0.1F, 0.2F, 1.5F}, upwards}));
  EXPECT_FALSE(occluder.blocks({{5.0F, 0.2F, 0.0F}, upwards}));
  EXPECT_FALSE(occluder.blocks({{0.1F, 0.2F, 0.0F}, down}));
}

TEST(Occluder, WhatLiesBehindDoesNotCount) {
  const Occluder occluder = layers({1.0F, 2.0F});
  const Ray from_above{{0.1F, 0.2F, 3.0F}, upwards};
  EXPECT_FALSE(occluder.blocks(from_above));
  EXPECT_FALSE(occluder.nearest(from_above));
}

TEST(Occluder, RaysBeginAndEndWhereTheySay) {
  const Occluder occluder = layers({1.0F, 2.0F});
  const Point3f origin{0.1F, 0.2F, 0.0F};
  EXPECT_FALSE(occluder.blocks({origin, upwards, 0.0F, 0.5F}));
  EXPECT_TRUE(occluder.blocks({origin, upwards, 0.0F, 1.5F}));
  EXPECT_TRUE(occluder.blocks({origin, upwards, 1.5F}));
  EXPECT_FALSE(occluder.blocks({origin, upwards, 2.5F}));
  EXPECT_EQ(occluder.nearest({origin, upwards, 1.5F})->triangle, 1U);
  EXPECT_EQ(occluder.nearest({origin, upwards, 0.0F, 1.5F})->triangle, 0U);
}

// Of distances: Embree divides by an approximate reciprocal where the processor has no AVX-512

TEST(Occluder, DistancesCountInTheLengthOfTheDirection) {
  const Occluder occluder = layers({1.0F, 2.0F});
  EXPECT_FLOAT_EQ(occluder.nearest({{0.1F, 0.2F, 0.0F}, upwards})->distance, 1.0F);
  EXPECT_FLOAT_EQ(occluder.nearest({{0.1F, 0.2F, 0.0F}, {0.0F, 0.0F, 4.0F}})->distance, 0.25F);
}

TEST(Occluder, NearestIsTheFirstOfThoseThatCount) {
  const Occluder occluder = layers({3.0F, 1.0F, 2.0F});
  const Ray ray{{0.1F, 0.2F, 0.0F}, upwards};
  EXPECT_EQ(occluder.nearest(ray)->triangle, 1U);
  EXPECT_EQ(occluder.nearest(ray, [](std::uint32_t t) { return t != 1; })->triangle, 2U);
  EXPECT_FLOAT_EQ(occluder.nearest(ray, [](std::uint32_t t) { return t == 0; })->distance, 3.0F);
  EXPECT_FALSE(occluder.nearest(ray, [](std::uint32_t) { return false; }));
}

constexpr std::uint32_t all_rays = 0xFFFF;

TEST(Occluder, NothingHidesNothing) {
  const Occluder nothing({}, {});
  const Occluder points_only({{1.0F, 2.0F, 3.0F}}, {});
  for (const Occluder* occluder : {&nothing, &points_only}) {
    EXPECT_EQ(occluder->blocked(RayOrigins{}, upwards, 0.0F, all_rays), 0U);
    EXPECT_FALSE(occluder->blocks({{}, upwards}));
    EXPECT_FALSE(occluder->nearest({{}, upwards}));
    EXPECT_EQ(occluder->triangle_count(), 0U);
  }
}

class RandomScene : public RandomRays {
 protected:
  Occluder triangles(std::size_t count, const std::stop_token& stop = {}) {
    std::vector<Point3f> vertices;
    std::vector<Triangle> list;
    for (std::uint32_t n = 0; n < count; ++n) {
      const Point3f middle = point(50.0F);
      for (int k = 0; k < 3; ++k) vertices.push_back(middle + point(8.0F));
      list.push_back({3 * n, 3 * n + 1, 3 * n + 2});
    }
    return {std::move(vertices), std::move(list), stop};
  }
};

TEST_F(RandomScene, PacketsAnswerAsSingleRaysDo) {
  const Occluder occluder = triangles(400);
  constexpr float begin = 5.0F;
  std::size_t blocked_count = 0, asked_count = 0;
  for (std::uint32_t n = 0; n < 2000; ++n) {
    // Of each pattern of lanes that are asked, many packets; with one direction for all, and with one for each
    const std::uint32_t wanted = n % 3 == 0 ? all_rays : (n * 2654435761U) >> 16;
    const Point3f shared = point(1.0F);
    RayPacket packet;
    std::uint32_t expected = 0, expected_shared = 0;
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
      const Ray ray{point(60.0F), point(1.0F), begin};
      packet.set(l, ray);
      expected |= occluder.blocks(ray) ? 1U << l : 0U;
      expected_shared |= occluder.blocks({ray.origin, shared, begin}) ? 1U << l : 0U;
    }
    EXPECT_EQ(occluder.blocked(packet.origins, packet.directions, begin, wanted), expected & wanted) << n;
    EXPECT_EQ(occluder.blocked(packet.origins, shared, begin, wanted), expected_shared & wanted) << n;
    blocked_count += static_cast<std::size_t>(std::popcount(expected & wanted));
    asked_count += static_cast<std::size_t>(std::popcount(wanted));
  }
  EXPECT_TRUE(blocked_count > asked_count / 10 && blocked_count < 9 * asked_count / 10) << "the scene tests little";
}

TEST_F(RandomScene, PacketsAreAsFarAsSingleRays) {
  const Occluder occluder = triangles(400);
  constexpr float begin = 5.0F, infinity = std::numeric_limits<float>::infinity();
  // Of single rays and packets, both of which divide by an approximate reciprocal
  constexpr float tolerance = 1e-4F;
  std::size_t met = 0;
  for (std::uint32_t n = 0; n < 500; ++n) {
    const std::uint32_t wanted = n % 3 == 0 ? all_rays : (n * 2654435761U) >> 16;
    const Point3f shared = point(1.0F);
    RayPacket packet;
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) packet.set(l, {point(60.0F), point(1.0F), begin});
    const Occluder::Distances own = occluder.distances(packet.origins, packet.directions, begin, wanted),
                              of_shared = occluder.distances(packet.origins, shared, begin, wanted);
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
      const Point3f origin{packet.origins.x[l], packet.origins.y[l], packet.origins.z[l]},
          direction{packet.directions.x[l], packet.directions.y[l], packet.directions.z[l]};
      const auto expected = [&](const Point3f& d) {
        const auto hit = occluder.nearest({origin, d, begin});
        return (wanted >> l & 1U) != 0 && hit ? hit->distance : infinity;
      };
      if (const float distance = expected(direction); distance < infinity) {
        EXPECT_NEAR(own[l], distance, tolerance * distance);
        ++met;
      } else {
        EXPECT_EQ(own[l], infinity);
      }
      if (const float distance = expected(shared); distance < infinity)
        EXPECT_NEAR(of_shared[l], distance, tolerance * distance);
      else
        EXPECT_EQ(of_shared[l], infinity);
    }
  }
  EXPECT_GT(met, 500U) << "the scene tests little";
}

TEST_F(RandomScene, PacketsMeetTheTrianglesOfSingleRays) {
  const Occluder occluder = triangles(400);
  std::size_t met = 0;
  for (std::uint32_t n = 0; n < 500; ++n) {
    const std::uint32_t wanted = n % 3 == 0 ? all_rays : (n * 2654435761U) >> 16;
    const Point3f shared = point(1.0F);
    RayPacket packet;
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) packet.set(l, {point(60.0F), shared, 0.0F});
    const Occluder::Hits hits = occluder.nearest(packet.origins, shared, 0.0F, wanted);
    EXPECT_EQ(hits.distances, occluder.distances(packet.origins, shared, 0.0F, wanted));
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
      if (hits.distances[l] == std::numeric_limits<float>::infinity()) continue;
      const auto hit = occluder.nearest({{packet.origins.x[l], packet.origins.y[l], packet.origins.z[l]}, shared});
      ASSERT_TRUE(hit);
      EXPECT_EQ(hits.triangles[l], hit->triangle);
      ++met;
    }
  }
  EXPECT_GT(met, 500U) << "the scene tests little";
}

TEST_F(RandomScene, WhatBlocksIsTheNearestOfAll) {
  const Occluder occluder = triangles(400);
  for (int n = 0; n < 5000; ++n) {
    const Ray ray{point(60.0F), point(1.0F)};
    const auto nearest = occluder.nearest(ray);
    EXPECT_EQ(occluder.blocks(ray), nearest.has_value());
    if (!nearest) continue;
    const auto next = occluder.nearest(ray, [&](std::uint32_t t) { return t != nearest->triangle; });
    EXPECT_TRUE(!next || next->distance >= nearest->distance) << n;
  }
}

/// A fan of eight long triangles around a vertex, not quite in one plane, far from the origin of the scene.
class Fan : public RandomScene {
 protected:
  Fan() {
    const std::array<std::array<float, 2>, 8> rim{
        {{70, 0}, {50, 50}, {0, 70}, {-50, 50}, {-70, 0}, {-50, -50}, {0, -70}, {50, -50}}};
    for (const auto& [x, y] : rim) rim_.push_back(hub_ + Point3f{x, y, 3.0F * random()});
  }
  Occluder occluder() const {
    std::vector<Point3f> vertices{hub_};
    vertices.insert(vertices.end(), rim_.begin(), rim_.end());
    std::vector<Triangle> triangles;
    for (std::uint32_t n = 0; n < 8; ++n) triangles.push_back({0, 1 + n, 1 + (n + 1) % 8});
    return {vertices, triangles};
  }
  /// A ray to some point of a spoke, the hub among them.
  Ray ray_to_spoke(std::size_t n) {
    const Point3f target = hub_ + (n % 100 == 0 ? 0.0F : 0.49F * (random() + 1.0F)) * (rim_[n % 8] - hub_);
    const Point3f origin = hub_ + Point3f{300.0F * random(), 300.0F * random(), 200.0F + 100.0F * random()};
    return {origin, target - origin};
  }

 private:
  Point3f hub_{5000.3F, -3000.2F, 10.1F};
  std::vector<Point3f> rim_;
};

TEST_F(Fan, SharedEdgesAndASharedVertexLetNothingThrough) {
  const Occluder fan = occluder();
  for (std::size_t n = 0; n < 50000; ++n) {
    const Ray ray = ray_to_spoke(n);
    EXPECT_TRUE(fan.blocks(ray)) << n;
    RayPacket packet;
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) packet.set(l, ray);
    EXPECT_EQ(fan.blocked(packet.origins, packet.directions, 0.0F, all_rays), all_rays) << n;
  }
}

/// Embree keeps an error for each thread until somebody asks for it, and a cancelled build is one.
TEST_F(RandomScene, ACancelledBuildLeavesNothingToTheNext) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW((void)triangles(200'000, stop.get_token()), Cancelled);
  EXPECT_EQ(triangles(400).triangle_count(), 400U);
  EXPECT_EQ(triangles(400, std::stop_source().get_token()).triangle_count(), 400U);
}

TEST(PlacedMesh, MoreThanCanBeNumberedIsALimit) {
  constexpr std::size_t vertices_each = 1 << 16, tile_count = 1 << 16;
  const std::vector<Point3f> vertices(vertices_each);
  const std::vector<PlacedMesh> tiles(tile_count, PlacedMesh{{vertices, {}}, {0.0, 0.0}});
  EXPECT_THROW((void)occluder_of(tiles), LimitReached);
}

TEST(PlacedMesh, NumbersTrianglesThrough) {
  const std::vector<Point3f> vertices{{0.0F, 0.0F, 5.0F}, {10.0F, 0.0F, 5.0F}, {0.0F, 10.0F, 5.0F}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::array<PlacedMesh, 3> tiles{
      PlacedMesh{{vertices, triangles}, {-100.0, 0.0}}, {{}, {-50.0, 0.0}}, {{vertices, triangles}, {100.0, 50.0}}};
  const Occluder occluder = occluder_of(tiles);
  EXPECT_EQ(occluder.triangle_count(), 2U);
  EXPECT_EQ(occluder.nearest({{-98.0F, 2.0F, 0.0F}, upwards})->triangle, 0U);
  EXPECT_EQ(occluder.nearest({{102.0F, 52.0F, 0.0F}, upwards})->triangle, 1U);
  EXPECT_FALSE(occluder.blocks({{2.0F, 2.0F, 0.0F}, upwards}));
}

TEST(PlacedMesh, WhatTouchesAcrossABorderStillTouches) {
  // An edge of 33.3 m, as a float: far from the origin, sums of floats would leave gaps
  const double edge_m = static_cast<float>(33.3);
  const auto edge = static_cast<float>(edge_m);
  const std::vector<Point3f> vertices{{0.0F, 0.0F, 5.0F}, {edge, 0.0F, 5.0F}, {edge, edge, 5.0F}, {0.0F, edge, 5.0F}};
  const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}};
  std::vector<PlacedMesh> tiles;
  for (int i = -300; i < 300; ++i) tiles.push_back({{vertices, square}, {i * edge_m, 0.0}});
  const Occluder occluder = occluder_of(tiles);
  for (int i = -299; i < 300; ++i) {
    const auto border = static_cast<float>(i * edge_m);
    for (const float x : {border, std::nextafter(border, -1e9F), std::nextafter(border, 1e9F)})
      EXPECT_TRUE(occluder.blocks({{x, 7.0F, 0.0F}, upwards})) << i;
  }
}

}  // namespace
}  // namespace farlod
