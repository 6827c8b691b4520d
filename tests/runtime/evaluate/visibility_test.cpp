// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/visibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "evaluate/crowns_of_cell.hpp"
#include "evaluate/sky_directions.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

namespace farlod {
namespace {

std::vector<Point3f> random_origins(std::size_t count) {
  RandomPlaces random;
  std::vector<Point3f> origins;
  for (std::size_t n = 0; n < count; ++n) origins.push_back(random.place(45.0, 1.0, 11.0));
  return origins;
}

TEST(Visibility, CountsAsOneRayAfterTheOtherDoes) {
  TownByHand town;
  RandomPlaces random;
  for (int n = 0; n < 30; ++n) {
    const Point3f corner = random.place(40.0, 2.0, 18.0);
    town.add_box({corner.x, corner.y}, {random.between(2.0, 6.0), random.between(2.0, 6.0)}, corner.z);
  }
  const Occluder occluder = town.city();
  // Around the size of a packet and of a batch, and no round numbers
  for (const std::size_t origin_count : {0U, 1U, 15U, 16U, 17U, 100U})
    for (const std::size_t ray_count : {1U, 7U, 256U, 970U}) {
      const std::vector<Point3f> origins = random_origins(origin_count);
      const std::vector<Point3d> directions = SkyPartition(SkyWeight::cosine, ray_count).directions();
      const std::vector<std::uint32_t> free = count_free(occluder, origins, directions);
      ASSERT_EQ(free.size(), origins.size());
      for (std::size_t n = 0; n < origins.size(); ++n) {
        std::uint32_t expected = 0;
        for (const Point3d& d : directions)
          expected += occluder.blocks({origins[n], {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}})
                          ? 0U
                          : 1U;
        EXPECT_EQ(free[n], expected) << n << " of " << origin_count << ", " << ray_count << " rays";
      }
    }
}

TEST(Visibility, WithoutDirectionsNothingIsFree) {
  EXPECT_EQ(count_free(TownByHand().city(), random_origins(3), {}), (std::vector<std::uint32_t>{0, 0, 0}));
}

constexpr std::size_t ray_count = 5000;
/// A dozen operations on numbers of at most 1.
constexpr double rounding = 24 * std::numeric_limits<double>::epsilon();

const Point3d normals[] = {normalized(Point3d{0.3, -0.2, 0.9}),
                           normalized(Point3d{-1.0, 0.4, 0.05}),
                           {1.0, 0.0, 0.0},
                           {0.0, -1.0, 0.0},
                           normalized(Point3d{0.1, 0.2, -0.5})};

TEST(SkyDirections, FacingUpIsThePartitionInTheGridFrame) {
  const GridRotation rotation(Angle::degrees(20));
  const SkyDirections sky(SkyWeight::solid_angle, ray_count, rotation);
  const std::vector<Point3d> expected = SkyPartition(SkyWeight::solid_angle, ray_count).directions();
  ASSERT_EQ(sky.facing_up().size(), expected.size());
  EXPECT_EQ(sky.ray_count(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_EQ(sky.facing_up()[n], rotation.grid_from_city(expected[n]));
}

TEST(SkyDirections, TurningTheGridDoesNotTurnThem) {
  for (const DirectionSet set : {DirectionSet::partition, DirectionSet::fibonacci})
    for (const double bearing_deg : {0.0, 33.0, 121.0}) {
      const GridRotation rotation(Angle::degrees(bearing_deg));
      const SkyDirections turned(SkyWeight::cosine, ray_count, rotation, set), north(SkyWeight::cosine, ray_count, {}, set);
      for (std::size_t n = 0; n < ray_count; ++n)
        EXPECT_LE(norm(rotation.city_from_grid(turned.facing_up()[n]) - north.facing_up()[n]), rounding);
    }
}

TEST(SkyDirections, AroundANormalEachKeepsItsAngleToIt) {
  const std::vector<Point3d> local = SkyPartition(SkyWeight::cosine, ray_count).directions();
  const SkyDirections sky(SkyWeight::cosine, ray_count, {});
  for (const Point3d& normal : normals) {
    std::size_t n = 0;
    // Rays below the horizon are left out; what is left comes in the order of the partition
    for (const Point3d& d : sky.facing(normal)) {
      EXPECT_GT(d.z, 0.0);
      EXPECT_NEAR(norm(d), 1.0, rounding);
      while (n < local.size() && std::abs(local[n].z - dot(d, normal)) > rounding) ++n;
      ASSERT_LT(n, local.size()) << "a direction that is none of the partition's";
      ++n;
    }
  }
}

TEST(SkyDirections, AreTurnedAndNotMirrored) {
  const SkyDirections sky(SkyWeight::cosine, 300, {});
  const std::vector<Point3d> local = SkyPartition(SkyWeight::cosine, 300).directions();
  // Tilted so little that no ray is lost
  const Point3d normal = normalized(Point3d{0.01, 0.02, 1.0});
  const std::vector<Point3d> tilted = sky.facing(normal);
  ASSERT_EQ(tilted.size(), local.size()) << "choose a smaller tilt";
  for (std::size_t n = 2; n < local.size(); ++n) {
    EXPECT_NEAR(dot(tilted[n], tilted[n - 1]), dot(local[n], local[n - 1]), rounding);
    EXPECT_NEAR(dot(cross(tilted[n], tilted[n - 1]), tilted[n - 2]), dot(cross(local[n], local[n - 1]), local[n - 2]), rounding);
  }
}

TEST(SkyDirections, ATiltedPlaneInTheOpenSeesItsShareOfTheSky) {
  for (const double tilt_deg : {1.0, 20.0, 45.0, 90.0, 135.0, 179.0})
    for (const double azimuth_deg : {0.0, 77.0, 200.0}) {
      const Angle tilt = Angle::degrees(tilt_deg), azimuth = Angle::degrees(azimuth_deg);
      const Point3d normal{sin(tilt) * sin(azimuth), sin(tilt) * cos(azimuth), cos(tilt)};
      // The border is the horizon: half an ellipse on the disk, half a great circle on the hemisphere
      const double error = sampling_error(ray_count, std::numbers::pi);
      const auto share = [&](SkyWeight weight) {
        return static_cast<double>(SkyDirections(weight, ray_count, {}).facing(normal).size()) / static_cast<double>(ray_count);
      };
      EXPECT_NEAR(share(SkyWeight::cosine), oracles::tilted_cos(tilt.radians()), error) << tilt_deg;
      EXPECT_NEAR(share(SkyWeight::solid_angle), 1.0 - tilt.radians() / std::numbers::pi, error) << tilt_deg;
    }
}

TEST(SkyDirections, AFloorSeesNoSkyAndARoofAll) {
  const SkyDirections sky(SkyWeight::cosine, 145, {});
  EXPECT_TRUE(sky.facing({0.0, 0.0, -1.0}).empty());
  EXPECT_EQ(sky.facing({0.0, 0.0, 1.0}).size(), 145U);
}

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};

SkyDirections fibonacci(SkyWeight weight, std::size_t rays) { return {weight, rays, {}, DirectionSet::fibonacci}; }

TEST(FibonacciDirections, AreAsManyAsAskedForAndAllAbove) {
  for (const SkyWeight weight : both_weights)
    for (const std::size_t rays : {1U, 2U, 145U, 1000U}) {
      const SkyDirections sky = fibonacci(weight, rays);
      EXPECT_EQ(sky.ray_count(), rays);
      ASSERT_EQ(sky.facing_up().size(), rays);
      for (const Point3d& d : sky.facing_up()) {
        EXPECT_GT(d.z, 0.0);
        EXPECT_NEAR(norm(d), 1.0, rounding);
      }
    }
}

TEST(FibonacciDirections, EachBandHasItsShare) {
  for (const SkyWeight weight : both_weights) {
    const SkyDirections sky = fibonacci(weight, ray_count);
    for (const auto& [low, high] : {std::pair(0.0, 0.1), {0.3, 0.35}, {0.0, 1.0}, {0.97, 1.0}}) {
      const auto inside = [&, from = low, to = high](const Point3d& d) {
        const double share = sky_share_above(weight, d);
        return share >= from && share < to;
      };
      const auto count = std::count_if(sky.facing_up().begin(), sky.facing_up().end(), inside);
      EXPECT_NEAR(static_cast<double>(count), (high - low) * ray_count, 1.0);
    }
  }
}

/// Multiples of the golden ratio, n of them, fill each interval of the circle but for 3 + (1/ln φ + 1/ln 2) ln n (Kuipers &
/// Niederreiter, theorem 3.4 of chapter 2); those of a band are n in a row, and the band itself is off by one.
double most_off(std::size_t n) {
  return 4.0 + (1.0 / std::log(std::numbers::phi) + 1.0 / std::numbers::ln2) * std::log(static_cast<double>(n));
}

TEST(FibonacciDirections, EachSectorOfABandHasItsShare) {
  constexpr std::size_t many = 100000;
  for (const SkyWeight weight : both_weights) {
    const SkyDirections sky = fibonacci(weight, many);
    for (const auto& [low, high] : {std::pair(0.0, 0.2), {0.3, 0.7}, {0.9, 1.0}})
      for (const double sector : {0.01, 0.1, 0.3})
        for (const double begin : {0.0, 0.17, 0.55}) {
          const auto inside = [&, from = low, to = high](const Point3d& d) {
            const double turns = azimuth_of(horizontal(d)).radians() / (2.0 * std::numbers::pi),
                         share = sky_share_above(weight, d);
            return share >= from && share < to && turns >= begin && turns < begin + sector;
          };
          const auto count = std::count_if(sky.facing_up().begin(), sky.facing_up().end(), inside);
          EXPECT_NEAR(static_cast<double>(count), (high - low) * sector * many, most_off(many)) << sector;
        }
  }
}

TEST(SkyDirections, AStopEndsTheirMaking) {
  std::stop_source stop;
  stop.request_stop();
  for (const DirectionSet set : {DirectionSet::partition, DirectionSet::fibonacci})
    EXPECT_THROW(SkyDirections(SkyWeight::cosine, 1000, {}, set, stop.get_token()), Cancelled);
}

/// Root of the mean square of the errors that some directions make of finite walls, of many heights and at many azimuths.
double error_of_walls(SkyWeight weight, DirectionSet set, std::size_t rays) {
  const SkyDirections sky(weight, rays, {}, set);
  double sum = 0.0;
  int walls = 0;
  for (int n = 0; n < 60; ++n)
    for (const double H : {4.0, 11.0, 30.0}) {
      const double d = 10.0, left = 3.0 + n % 7 * 4.0, right = 50.0 - left, turn = 0.37 * n;
      const auto is_free = [&](const Point3d& s) {
        const double across = s.x * std::cos(turn) + s.y * std::sin(turn), along = s.y * std::cos(turn) - s.x * std::sin(turn);
        if (across <= 0.0 || along * d / across < -left || along * d / across > right) return true;
        return s.z * d / across > H;
      };
      const auto free = std::count_if(sky.facing_up().begin(), sky.facing_up().end(), is_free);
      const double truth = weight == SkyWeight::cosine ? oracles::finite_wall_cos(H, d, left, right)
                                                       : oracles::finite_wall_solid(H, d, left, right);
      sum += std::pow(static_cast<double>(free) / static_cast<double>(rays) - truth, 2);
      ++walls;
    }
  return std::sqrt(sum / walls);
}

TEST(FibonacciDirections, AreNoWorseThanThePartition) {
  for (const SkyWeight weight : both_weights)
    for (const std::size_t rays : {256U, 1000U, 4000U}) {
      const double lattice = error_of_walls(weight, DirectionSet::fibonacci, rays),
                   partition = error_of_walls(weight, DirectionSet::partition, rays);
      EXPECT_LE(lattice, partition) << rays << " rays";
    }
}

constexpr std::size_t lanes = ReceiverPacket::lanes;
constexpr double half_m = 60.0;  ///< of the raster's edge

/// A raster of 1 m of 100 trees a hectare, each a paraboloid, with the bottoms at a quarter of the tops.
std::vector<Crown> canopy() {
  RandomPlaces random;
  struct Tree {
    Point3f place;
    float radius_m;
  };
  std::vector<Tree> trees(static_cast<std::size_t>(4.0 * half_m * half_m * 0.01));
  for (Tree& tree : trees) tree = {random.place(half_m, 6.0, 18.0), random.between(2.0, 5.0)};
  std::vector<Crown> pixels;
  for (double x = 0.5 - half_m; x < half_m; x += 1.0)
    for (double y = 0.5 - half_m; y < half_m; y += 1.0) {
      double top_m = 0.0;
      for (const Tree& tree : trees) {
        const double away = std::hypot(x - static_cast<double>(tree.place.x), y - static_cast<double>(tree.place.y)) /
                            static_cast<double>(tree.radius_m);
        if (away < 1.0) top_m = std::max(top_m, static_cast<double>(tree.place.z) * (1.0 - 0.5 * away * away));
      }
      if (top_m > 0.0)
        pixels.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(0.25 * top_m),
                          static_cast<float>(top_m), 0.5F, CrownShape::prism, Foliage::unknown, 0});
    }
  return pixels;
}

ReceiverPacket receivers_around(Point2d middle, float step_m) {
  ReceiverPacket packet;
  for (std::size_t l = 0; l < lanes; ++l)
    packet.add({l,
                {static_cast<float>(middle.x) + step_m * static_cast<float>(l % 4),
                 static_cast<float>(middle.y) + step_m * static_cast<float>(l / 4), 1.5F}});
  return packet;
}

TEST(CanopyByPlace, ErrsLittleAgainstAllPixels) {
  // Twice of what was measured here; docs/concepts.md, "Canopies of rasters", has the errors of a real canopy
  constexpr double max_allowed = 0.0045, mean_allowed = 0.0012;
  const std::vector<Crown> pixels = canopy();
  const AzimuthSampling azimuths = AzimuthSampling::even(320, {});
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::beer}) {
    const CanopySettings settings{rule};
    const CrownBatches all(pixels, settings);
    CanopySky exact(azimuths);
    CanopyByPlace merged(pixels, settings, azimuths);
    double sum = 0.0, max = 0.0, hidden = 0.0, count = 0.0;
    for (double x = -40.0; x < 40.0; x += 17.0)
      for (double y = -40.0; y < 40.0; y += 17.0) {
        const ReceiverPacket receivers = receivers_around({x, y}, 2.0F);
        const SkyProfile open(azimuths);
        const CanopyShares expected = exact.evaluate(open, receivers, all), got = merged.evaluate(open, receivers, {});
        for (std::size_t l = 0; l < lanes; ++l) {
          const double error = std::abs(static_cast<double>(got.lost[l]) - static_cast<double>(expected.lost[l]));
          sum += error, count += 1.0, max = std::max(max, error);
          hidden += static_cast<double>(expected.lost[l]);
        }
      }
    RecordProperty("max", std::to_string(max));
    RecordProperty("mean", std::to_string(sum / count));
    EXPECT_LE(max, max_allowed);
    EXPECT_LE(sum / count, mean_allowed);
    EXPECT_GT(hidden / count, 0.2) << "the canopy hides too little to tell";
  }
}

TEST(CanopyByPlace, DoesNotDependOnTheRestOfThePacket) {
  const std::vector<Crown> pixels = canopy();
  const AzimuthSampling azimuths = AzimuthSampling::even(64, {});
  CanopyByPlace sky(pixels, {}, azimuths);
  // Over several places
  const ReceiverPacket receivers = receivers_around({-11.0, 3.0}, 7.0F);
  SkyProfile::Rows behind(azimuths.size()), behind_alone(azimuths.size());
  const SkyProfile open(azimuths);
  const CanopyShares together = sky.evaluate(open, receivers, {behind});
  for (std::size_t l = 0; l < lanes; ++l) {
    ReceiverPacket alone;
    alone.add({0, {receivers.x[l], receivers.y[l], receivers.z[l]}});
    const CanopyShares of_one = sky.evaluate(open, alone, {behind_alone});
    EXPECT_EQ(together.lost[l], of_one.lost[0]);
    EXPECT_EQ(together.behind[l], of_one.behind[0]);
    for (std::size_t k = 0; k < azimuths.size(); ++k) EXPECT_EQ(behind[k][l], behind_alone[k][0]);
  }
}

}  // namespace
}  // namespace farlod
