// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/exact_sky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "scene/ray_scenes.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

struct PlacedReceiver {
  const char* name;
  Point3f place, normal;
};

/// In the frame of the town.
constexpr std::array<PlacedReceiver, 9> receivers_in_town{
    {{"in a street", {-0.4F, -20.3F, 1.5F}, {0.0F, 0.0F, 1.0F}},
     {"below a roof without walls", {0.2F, -7.7F, 1.5F}, {0.0F, 0.0F, 1.0F}},
     {"below a projecting floor", {2.5F, 7.3F, 2.0F}, {0.0F, 0.0F, 1.0F}},
     {"below a bridge", {-1.0F, 7.2F, 1.0F}, {0.0F, 0.0F, 1.0F}},
     {"behind a window", {-25.8F, 2.1F, 1.2F}, {0.0F, -1.0F, 0.0F}},
     {"on a roof", {8.1F, 8.2F, 13.6F}, {0.0F, 0.0F, 1.0F}},
     {"tilted", {-0.5F, -38.0F, 8.0F}, {0.48F, 0.64F, 0.6F}},
     {"on a wall", {-4.99F, -10.0F, 2.0F}, {1.0F, 0.0F, 0.0F}},
     {"looking down", {0.3F, 25.0F, 19.0F}, {0.8F, 0.0F, -0.6F}}}};

/// Blocks of houses with a projecting floor, a bridge between two of them, a roof without walls, and a wall with a window, in 6 ×
/// 6 cells of 20 m around the origin.
class PackedTown : public testing::Test {
 protected:
  static Box2d box(double x0, double y0, double x1, double y1) {
    Box2d box;
    box.add({x0, y0});
    box.add({x1, y1});
    return box;
  }
  static CityModel town() {
    scenes::SceneBuilder builder;
    builder.add_box(box(-60.0, -60.0, 60.0, 60.0), -1.0, 0.0);
    for (int i = -3; i < 3; ++i)
      for (int j = -3; j < 3; ++j) {
        const double x = 19.0 * i + 3.0, y = 19.0 * j + 3.0, height = 6.0 + 2.5 * ((5 * i + 3 * j + 24) % 7);
        builder.add_box(box(x, y, x + 11.0, y + 12.0), -0.5, height);
      }
    builder.add_box(box(1.5, 2.0, 15.0, 16.0), 4.0, 5.0);
    builder.add_box(box(-6.0, 6.0, 4.0, 9.0), 4.5, 7.0);
    builder.add_polygon({{-14.0, -13.0, 9.0}, {18.0, -13.5, 12.0}, {17.0, -1.0, 11.0}, {-15.0, -2.0, 8.0}});
    const double y = 1.0;
    builder.add_wall({-30.0, y}, {-27.0, y}, 0.0, 4.0);
    builder.add_wall({-25.0, y}, {-18.0, y}, 0.0, 4.0);
    builder.add_wall({-27.0, y}, {-25.0, y}, 0.0, 1.0);
    builder.add_wall({-27.0, y}, {-25.0, y}, 2.5, 4.0);
    return builder.city();
  }
  PackedTown() : package_(packed()), city_(package_, {}) {}
  [[nodiscard]] PackageReader packed() const {
    const CityModel city = town();
    scenes::pack_city(city, scenes::grid_covering(city, {}, 20.0, 3, 4), folder_.path() / "town.farlod",
                      scenes::small_maps(FarMapKind::horizon));
    return PackageReader(folder_.path() / "town.farlod");
  }

  /// As it is placed in the scene of the city.
  [[nodiscard]] PlacedReceiver in_scene(const PlacedReceiver& receiver) const {
    const Point2d middle = package_.grid().middle_corner();
    const Point3f origin{static_cast<float>(middle.x), static_cast<float>(middle.y),
                         static_cast<float>(package_.manifest().height_origin_m)};
    return {receiver.name, receiver.place - origin, receiver.normal};
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
  WholeCityOnDemand city_;
};

Point3d exactly(const Point3f& p) { return {p.x, p.y, p.z}; }

struct Sampled {
  double share = 0.0, deviation = 0.0;
};

/// By rays with the sky's weight, two at random in each square of a partition. The standard deviation of the mean follows from
/// the differences of both; those below the level see no sky.
Sampled share_by_rays(const Occluder& city, const PlacedReceiver& receiver, std::size_t squares) {
  const Point3d normal = normalized(Point3d{receiver.normal.x, receiver.normal.y, receiver.normal.z});
  const Point3d aside = std::abs(normal.x) < 0.7 ? Point3d{1.0, 0.0, 0.0} : Point3d{0.0, 1.0, 0.0};
  const Point3d first = normalized(cross(aside, normal)), second = cross(normal, first);
  std::mt19937_64 random(20120901);
  const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto sees_sky = [&](std::size_t i, std::size_t j) {
    const double u = (static_cast<double>(i) + share()) / static_cast<double>(squares);
    const double azimuth = 2.0 * std::numbers::pi * (static_cast<double>(j) + share()) / static_cast<double>(squares);
    const double out = std::sqrt(u);
    const Point3d d = (out * std::cos(azimuth)) * first + (out * std::sin(azimuth)) * second + std::sqrt(1.0 - u) * normal;
    const Point3f direction{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    return d.z > 0.0 && !city.blocks({receiver.place, direction});
  };
  double seen = 0.0, differing = 0.0;
  for (std::size_t i = 0; i < squares; ++i)
    for (std::size_t j = 0; j < squares; ++j) {
      const bool a = sees_sky(i, j), b = sees_sky(i, j);
      seen += (a ? 0.5 : 0.0) + (b ? 0.5 : 0.0);
      differing += a != b ? 1.0 : 0.0;
    }
  const auto count = static_cast<double>(squares * squares);
  return {seen / count, 0.5 * std::sqrt(differing) / count};
}

TEST_F(PackedTown, ItsSkyIsThatOfManyRays) {
  ExactSky exact(city_.triangles());
  for (const PlacedReceiver& in_town : receivers_in_town) {
    const PlacedReceiver receiver = in_scene(in_town);
    const double sky = exact.share_of_sky(64, exactly(receiver.place), receiver.normal, SkyWeight::cosine);
    const Sampled sampled = share_by_rays(city_.city().occluder(), receiver, 400);
    // Five standard deviations, of 9 receivers; and the float of a direction beside an edge, of which few hundred are in sight
    EXPECT_NEAR(sky, sampled.share, 5.0 * sampled.deviation + 1e-5) << receiver.name;
    EXPECT_GT(sky, 0.005) << receiver.name;
    EXPECT_LT(sky, 0.999) << receiver.name;
  }
}

/// The rounding of some hundred arcs in each wedge, as in wedge_sky_test.cpp.
constexpr double arcs_rounding = 64.0 * 256.0 * 10.0 * 0.5 * std::numeric_limits<double>::epsilon();

TEST_F(PackedTown, ItsSkyIsThatOfAllTrianglesOneByOne) {
  ExactSky exact(city_.triangles());
  for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle})
    for (const PlacedReceiver& in_town : receivers_in_town) {
      const PlacedReceiver receiver = in_scene(in_town);
      const Point3d eye = exactly(receiver.place);
      const Point3d normal = normalized(Point3d{receiver.normal.x, receiver.normal.y, receiver.normal.z});
      double sum = 0.0;
      for (int k = 0; k < 64; ++k) {
        const double width = 2.0 * std::numbers::pi / 64.0;
        WedgeSky sky;
        sky.begin({{std::cos(k * width), std::sin(k * width)}, std::tan(width)}, normal, weight);
        for (const auto& [a, b, c] : city_.triangles().triangles()) {
          sky.add({a - eye, b - eye, c - eye});
        }
        sum += sky.sky().sky;
      }
      EXPECT_NEAR(exact.share_of_sky(64, exactly(receiver.place), receiver.normal, weight), sum / (2.0 * std::numbers::pi),
                  arcs_rounding)
          << receiver.name;
    }
}

/// A surface through random heights of pixels of a metre, and receivers above it that look anywhere.
TEST(ExactSky, EdgesOfAnUnbrokenSurfaceTellItsSky) {
  constexpr int edge = 60;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> rise(0.0, 2.5), part(-1.0, 1.0);
  std::vector<double> height_m(edge * edge);
  for (double& height : height_m) height = part(random) > 0.9 ? 4.0 * rise(random) : rise(random);
  const auto corner = [&](int x, int y) {
    return Point3d{double(x), double(y), height_m[static_cast<std::size_t>(y * edge + x)]};
  };
  std::vector<TriangleIndex::Corners> triangles;
  for (int y = 0; y + 1 < edge; ++y)
    for (int x = 0; x + 1 < edge; ++x) {
      triangles.push_back({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
      triangles.push_back({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
    }
  const TriangleIndex index(triangles);
  ExactSky any(index), unbroken(index, ExactSky::Triangles::of_unbroken_surface);
  for (int n = 0; n < 12; ++n) {
    const int x = 18 + 2 * n, y = 40 - 2 * n;
    const double highest = std::max({corner(x, y).z, corner(x + 1, y).z, corner(x + 1, y + 1).z, corner(x, y + 1).z});
    const Point3d place{x + 0.35, y + 0.6, highest + 0.2};
    const auto component = [&] { return static_cast<float>(part(random)); };
    const Point3f normal = n % 3 == 0 ? Point3f{0.0F, 0.0F, 1.0F} : Point3f{component(), component(), component()};
    for (const SkyWeight weight : {SkyWeight::cosine, SkyWeight::solid_angle})
      EXPECT_NEAR(unbroken.share_of_sky(64, place, normal, weight), any.share_of_sky(64, place, normal, weight), 1e-9) << n;
  }
}

TEST_F(PackedTown, ItsTrianglesAreThoseThatRaysMeet) {
  EXPECT_EQ(city_.triangles().triangles().size(), city_.city().occluder().triangle_count());
  const Cell cell{1, -2};
  const Point3f place{3.1F, 4.7F, 1.3F};
  // Rays round to floats below 64 m
  constexpr double rounding_m = 0.5 * 64.0 * std::numeric_limits<float>::epsilon();
  EXPECT_LE(norm(city_.scene_from_cell(place, cell) - exactly(city_.city().scene_from_cell(place, cell))), 2.0 * rounding_m);
  // From above the middle of each that is not upright, a ray down meets it or what lies above it
  std::size_t met = 0;
  for (const auto& [a, b, c] : city_.triangles().triangles()) {
    const Point3d middle = (1.0 / 3.0) * (a + b + c);
    if (std::abs(normalized(cross(b - a, c - a)).z) < 0.1) continue;
    const auto hit = city_.city().occluder().nearest(
        {{static_cast<float>(middle.x), static_cast<float>(middle.y), 100.0F}, {0.0F, 0.0F, -1.0F}});
    ASSERT_TRUE(hit.has_value());
    ++met;
    EXPECT_GE(100.0 - static_cast<double>(hit->distance), middle.z - 1e-4);
  }
  EXPECT_GT(met, 100U);
}

}  // namespace
}  // namespace farlod
