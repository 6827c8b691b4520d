// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/frame.hpp"
#include "farlod/angle.hpp"
#include "horizon/kernels.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "tests/runtime/horizon/horizon_oracle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr SkyWeight both_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};
constexpr Point3f up{0.0F, 0.0F, 1.0F}, down{0.0F, 0.0F, -1.0F};

/// Normals that look up, up a little aside, along a roof, along a wall, slightly and steeply downward.
std::vector<Point3f> some_normals(RandomPlaces& random) {
  std::vector<Point3f> normals{up, down, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, {-0.6F, 0.0F, 0.8F}, {0.0F, 0.8F, -0.6F}};
  for (const double z : {0.999, 0.9, 0.5, 0.1, 0.01, 0.0, -0.01, -0.3, -0.9, -0.999}) normals.push_back(random.direction_at(z));
  return normals;
}

/// A receiver in each lane, each with a normal and a horizon of its own: level parts, low and high ones, some up to the zenith.
class RandomHorizons {
 public:
  explicit RandomHorizons(const AzimuthSampling& ring) : ring_(ring), horizon_(ring) {
    std::vector<std::uint32_t> bins(ring.size());
    std::iota(bins.begin(), bins.end(), 0U);
    for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane) {
      for (std::size_t k = 0; k < ring.size(); ++k) slopes_[lane].push_back(some_slope());
      horizon_.raise(slopes_[lane], only(lane), bins);
    }
  }
  [[nodiscard]] const PacketHorizon& horizon() const { return horizon_; }
  [[nodiscard]] double expected(SkyWeight weight, std::size_t lane, const Point3f& normal) const {
    return expected_sky(weight, normal, ring_, [&](std::size_t k) { return double{slopes_[lane][k]}; });
  }

 private:
  float some_slope() {
    const float kind = random_.between(0.0, 1.0);
    if (kind < 0.15F) return 0.0F;
    if (kind > 0.97F) return std::numeric_limits<float>::infinity();
    return std::tan(random_.between(0.0, kind < 0.5F ? 0.2 : 1.55));
  }
  const AzimuthSampling& ring_;
  RandomPlaces random_;
  PacketHorizon horizon_;
  std::array<std::vector<float>, ReceiverPacket::lanes> slopes_;
};

ReceiverPacket packet_looking(std::span<const Point3f> normals) {
  ReceiverPacket packet;
  for (std::size_t n = 0; n < ReceiverPacket::lanes; ++n) packet.add({n, {}, normals[n % normals.size()]});
  return packet;
}

TEST(SkyAbove, HasTheRaysAboveBothHorizonsBesideThem) {
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  const RandomHorizons random_horizons(ring);
  const PacketHorizon& horizon = random_horizons.horizon();
  RandomPlaces random;
  std::vector<RayBetweenAzimuths> rays;
  for (std::uint32_t k = 0; k < ring.size(); ++k) {
    const std::uint32_t after = (k + 1) % static_cast<std::uint32_t>(ring.size());
    const std::size_t lane = k % packet_lanes;
    // A ray along a horizon is not above it
    for (const float slope : {horizon.row(k)[lane], horizon.row(after)[lane], random.between(0.0, 3.0), -1.0F})
      rays.push_back({k, after, slope});
  }
  for (const KernelTarget& target : runnable_kernels()) {
    std::vector<std::uint16_t> above(rays.size());
    target.sky->find_rays_above(horizon.slopes(), rays, above.data());
    for (std::size_t n = 0; n < rays.size(); ++n)
      for (std::size_t l = 0; l < packet_lanes; ++l)
        EXPECT_EQ(has_bit(above[n], l), std::max(horizon.row(rays[n].before)[l], horizon.row(rays[n].after)[l]) < rays[n].slope)
            << target.name;
  }
}

TEST(SkyAbove, IsTheIntegralOverRandomHorizons) {
  RandomPlaces random;
  for (const std::size_t azimuths : {1U, 8U, 64U, 256U}) {
    const AzimuthSampling ring = AzimuthSampling::even(azimuths, GridRotation(Angle::degrees(11.0)));
    const RandomHorizons random_horizons(ring);
    const std::vector<Point3f> normals = some_normals(random);
    for (const SkyWeight weight : both_weights) {
      const auto sky = random_horizons.horizon().sky_above(weight, packet_looking(normals));
      for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane)
        EXPECT_NEAR(sky[lane], random_horizons.expected(weight, lane, normals[lane]), sky_rounding(azimuths, normals[lane]))
            << "lane " << lane << ", normal z " << normals[lane].z;
    }
  }
}

TEST(SkyAbove, WhereAllLookUpAsWellAsWhereOneDoesNot) {
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  const RandomHorizons random_horizons(ring);
  std::vector<Point3f> normals(ReceiverPacket::lanes, up);
  const auto alone = random_horizons.horizon().sky_above(SkyWeight::cosine, packet_looking(normals));
  normals.back() = {0.6F, 0.0F, 0.8F};
  const auto mixed = random_horizons.horizon().sky_above(SkyWeight::cosine, packet_looking(normals));
  for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane) {
    EXPECT_NEAR(alone[lane], random_horizons.expected(SkyWeight::cosine, lane, up), sky_rounding(64, up));
    if (lane + 1 < ReceiverPacket::lanes) {
      EXPECT_NEAR(mixed[lane], alone[lane], 2.0 * sky_rounding(64, up));
    }
  }
}

TEST(SkyAbove, WhereAllLookLevelAsWellAsWhereOneDoesNot) {
  RandomPlaces random;
  const AzimuthSampling ring = AzimuthSampling::even(64, {});
  const RandomHorizons random_horizons(ring);
  // Of one wall, and of many
  for (const bool alike : {true, false}) {
    std::vector<Point3f> normals(ReceiverPacket::lanes, random.direction_at(0.0));
    if (!alike)
      for (Point3f& normal : normals) normal = random.direction_at(0.0);
    const auto sky = random_horizons.horizon().sky_above(SkyWeight::cosine, packet_looking(normals));
    for (std::size_t lane = 0; lane < ReceiverPacket::lanes; ++lane)
      EXPECT_NEAR(sky[lane], random_horizons.expected(SkyWeight::cosine, lane, normals[lane]), sky_rounding(64, normals[lane]));
  }
}

TEST(SkyAbove, ALevelHorizonLeavesAllAndAnEndlessOneNothing) {
  const AzimuthSampling ring = AzimuthSampling::even(256, {});
  PacketHorizon horizon(ring);
  const std::vector<Point3f> ups(ReceiverPacket::lanes, up), downs(ReceiverPacket::lanes, down);
  for (const SkyWeight weight : both_weights) {
    for (const float share : horizon.sky_above(weight, packet_looking(ups))) EXPECT_EQ(share, 1.0F);
    for (const float share : horizon.sky_above(weight, packet_looking(downs))) EXPECT_EQ(share, 0.0F);
  }
  const std::vector<float> endless{std::numeric_limits<float>::infinity()};
  horizon.raise(endless, everybody, std::vector<std::uint32_t>(ring.size(), 0));
  for (const SkyWeight weight : both_weights)
    for (const float share : horizon.sky_above(weight, packet_looking(ups))) EXPECT_EQ(share, 0.0F);
}

/// An even horizon is rounded the same way at each azimuth, so that errors add up and do not cancel.
TEST(SkyAbove, ManyAzimuthsRoundNoMoreThanFew) {
  constexpr std::size_t azimuths = 300'000;
  const AzimuthSampling ring = AzimuthSampling::even(azimuths, {});
  const std::vector<Point3f> ups(ReceiverPacket::lanes, up), level(ReceiverPacket::lanes, {1.0F, 0.0F, 0.0F}),
      tilted(ReceiverPacket::lanes, {0.6F, 0.0F, 0.8F});
  for (const float slope : {0.1F, 0.3F, 0.7F, 1.9F}) {
    PacketHorizon horizon(ring);
    horizon.raise(std::vector{slope}, everybody, std::vector<std::uint32_t>(azimuths, 0));
    // Parts of the normal that point outwards average to 0, and those in front of a wall to 1/π
    const double t = slope, upwards = 1.0 / (1.0 + t * t), wall = (std::atan(1.0 / t) - t * upwards) / std::numbers::pi;
    EXPECT_NEAR(horizon.sky_above(SkyWeight::cosine, packet_looking(ups))[0], upwards, sky_rounding(azimuths, up));
    EXPECT_NEAR(horizon.sky_above(SkyWeight::cosine, packet_looking(level))[0], wall, sky_rounding(azimuths, level[0]));
    EXPECT_NEAR(horizon.sky_above(SkyWeight::solid_angle, packet_looking(ups))[0], 1.0 - t / std::sqrt(1.0 + t * t),
                sky_rounding(azimuths, up));
    // Behind the tilted receiver, too, the sky is above its own plane of slope 0.75
    if (slope > 0.75F) {
      EXPECT_NEAR(horizon.sky_above(SkyWeight::cosine, packet_looking(tilted))[0], 0.8 * upwards,
                  sky_rounding(azimuths, tilted[0]));
    }
  }
}

constexpr SkyWeight partition_weights[] = {SkyWeight::cosine, SkyWeight::solid_angle};
constexpr std::size_t sizes[] = {1, 2, 7, 145, 290, 1000, 5000};

/// A dozen operations on numbers below 4π, each rounded once.
constexpr double rounding = 12 * 4 * std::numbers::pi * std::numeric_limits<double>::epsilon();

struct Published {
  SkyWeight weight;
  std::size_t cells, rings;
  std::vector<std::size_t> innermost;  ///< k_1, k_2, … as far as they are printed
};

TEST(SkyPartition, RingsAreThoseOfBeckersAndBeckers) {
  const auto solid = SkyWeight::solid_angle, cosine = SkyWeight::cosine;
  const Published published[] = {{solid, 145, 8, {1, 8, 20, 38, 60, 86, 115, 145}},
                                 {solid, 290, 11, {1, 9, 22, 41, 65, 94, 128, 165, 205, 247, 290}},
                                 {solid, 1000, 20, {1, 10, 25, 45, 72, 105, 143, 186, 234}},
                                 {solid, 5000, 44, {1, 17, 35, 59, 89}},
                                 {cosine, 145, 7, {1, 10, 24, 45, 72, 105, 145}},
                                 {cosine, 290, 10, {1, 8, 21, 41, 67, 99, 137, 182, 233, 290}},
                                 {cosine, 1000, 18, {1, 10, 25, 46, 73, 107, 147, 193}},
                                 {cosine, 5000, 40, {1, 11, 26, 47, 75}}};
  for (const Published& p : published) {
    std::vector<std::size_t> rings = SkyPartition(p.weight, p.cells).cells_inside();
    EXPECT_EQ(rings.size(), p.rings) << p.cells;
    EXPECT_EQ(rings.back(), p.cells);
    rings.resize(p.innermost.size());
    EXPECT_EQ(rings, p.innermost) << p.cells;
  }
}

TEST(SkyPartition, TheZenithIsOneCellAndTheNextCircleHoldsSixOrSevenAtLeast) {
  for (const SkyWeight weight : partition_weights) {
    std::size_t fewest = 1000;
    for (std::size_t cells = 10; cells < 2000; ++cells) {
      const std::vector<std::size_t> rings = SkyPartition(weight, cells).cells_inside();
      EXPECT_EQ(rings.front(), 1U);
      EXPECT_TRUE(std::adjacent_find(rings.begin(), rings.end(), std::greater_equal<>()) == rings.end()) << cells;
      fewest = std::min(fewest, rings[1]);
    }
    EXPECT_EQ(fewest, weight == SkyWeight::cosine ? 6U : 7U);
  }
}

/// Directions of one ring, and how many cells lie inside of it.
struct Ring {
  std::vector<Point3d> directions;
  std::size_t inside;
};

std::vector<Ring> rings_of(const SkyPartition& sky) {
  const std::vector<Point3d> all = sky.directions();
  std::vector<Ring> rings;
  std::size_t first = 0;
  for (std::size_t r = 0; r < sky.ring_count(); ++r) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    rings.push_back({{begin, begin + static_cast<std::ptrdiff_t>(sky.cells_of_ring(r))}, first});
    first += sky.cells_of_ring(r);
  }
  EXPECT_EQ(first, all.size());
  return rings;
}

TEST(SkyPartition, EachDirectionLiesInItsRing) {
  for (const SkyWeight weight : partition_weights)
    for (const std::size_t cells : sizes)
      for (const Ring& ring : rings_of(SkyPartition(weight, cells)))
        for (const Point3d& d : ring.directions) {
          const double u = sky_share_above(weight, d) * static_cast<double>(cells);
          EXPECT_GE(u, static_cast<double>(ring.inside) - rounding * static_cast<double>(cells));
          EXPECT_LE(u, static_cast<double>(ring.inside + ring.directions.size()) + rounding * static_cast<double>(cells));
          EXPECT_NEAR(norm(d), 1.0, rounding);
          EXPECT_GE(d.z, 0.0);
        }
}

TEST(SkyPartition, EachSectorOfARingHasOneDirection) {
  for (const SkyWeight weight : partition_weights)
    for (const std::size_t cells : sizes)
      for (const Ring& ring : rings_of(SkyPartition(weight, cells))) {
        if (ring.directions.size() == 1) continue;
        std::vector<double> azimuths;
        for (const Point3d& d : ring.directions) azimuths.push_back(azimuth_of(horizontal(d)).radians());
        std::sort(azimuths.begin(), azimuths.end());
        const double sector = 2.0 * std::numbers::pi / static_cast<double>(azimuths.size());
        azimuths.push_back(azimuths.front() + 2.0 * std::numbers::pi);
        // Equally wide sectors with a direction at the same place of each: neighbors are one sector apart
        for (std::size_t n = 1; n < azimuths.size(); ++n) EXPECT_NEAR(azimuths[n] - azimuths[n - 1], sector, 2 * rounding);
      }
}

TEST(SkyPartition, RingsAreTurnedAgainstEachOther) {
  for (const SkyWeight weight : partition_weights) {
    const std::vector<Ring> rings = rings_of(SkyPartition(weight, 1000));
    for (std::size_t r = 2; r < rings.size(); ++r) {
      const double sector = 2.0 * std::numbers::pi / static_cast<double>(rings[r].directions.size());
      const double turn =
          azimuth_of(horizontal(rings[r].directions[0])).radians() - azimuth_of(horizontal(rings[r - 1].directions[0])).radians();
      EXPECT_GT(std::abs(turn), sector) << "ring " << r;
    }
  }
}

TEST(SkyPartition, DirectionAndShareAreInverse) {
  for (const SkyWeight weight : partition_weights)
    for (int step = 0; step <= 1000; ++step) {
      const double u = step / 1000.0, azimuth = 2.0 * std::numbers::pi * std::fmod(step * 0.618, 1.0);
      const Point3d d = sky_direction(weight, u, azimuth);
      EXPECT_NEAR(sky_share_above(weight, d), u, rounding);
      EXPECT_NEAR(norm(d), 1.0, rounding);
      if (step == 0) continue;  // the zenith has no azimuth
      EXPECT_NEAR(azimuth_of(horizontal(d)).radians(), azimuth, rounding);
    }
}

/// Discrepancy of n multiples of the golden ratio, the shares within a ring: n·D ≤ 3 + (1/ln φ + 1/ln 2)·ln n
/// (Kuipers & Niederreiter, Uniform Distribution of Sequences, chapter 2, theorem 3.4 with all partial quotients 1).
double discrepancy(std::size_t n) {
  const double count = static_cast<double>(n);
  return std::min(1.0, (3.0 + (1.0 / std::log(std::numbers::phi) + 1.0 / std::numbers::ln2) * std::log(count)) / count);
}

TEST(SkyPartition, MeanCosineIsTwoThirdsByViewFactorAndOneHalfBySolidAngle) {
  for (const SkyWeight weight : partition_weights) {
    const SkyPartition sky(weight, 5000);
    const double k = static_cast<double>(sky.size());
    double mean = 0.0, error = rounding;
    for (const Ring& ring : rings_of(sky)) {
      const double n = static_cast<double>(ring.directions.size()), inside = static_cast<double>(ring.inside);
      for (const Point3d& d : ring.directions) mean += d.z / k;
      // Koksma: variation within the ring times discrepancy, weighted by the ring's share of the sky
      const double variation = sky_direction(weight, inside / k, 0).z - sky_direction(weight, (inside + n) / k, 0).z;
      error += n / k * variation * discrepancy(ring.directions.size());
    }
    EXPECT_NEAR(mean, weight == SkyWeight::cosine ? 2.0 / 3.0 : 0.5, error);
  }
}

TEST(SkyPartition, AConstantHorizonHidesItsShare) {
  for (const SkyWeight weight : partition_weights)
    for (const double elevation_deg : {1.0, 10.0, 33.0, 60.0, 80.0}) {
      const SkyPartition sky(weight, 1000);
      const double sin_b = sin(Angle::degrees(elevation_deg));
      const double expected = weight == SkyWeight::cosine ? 1.0 - sin_b * sin_b : 1.0 - sin_b;
      std::size_t above = 0, largest_ring = 0;
      for (const Point3d& d : sky.directions()) above += d.z > sin_b ? 1U : 0U;
      for (std::size_t r = 0; r < sky.ring_count(); ++r) largest_ring = std::max(largest_ring, sky.cells_of_ring(r));
      // Only the ring through which the horizon runs can be counted wrongly
      const double error = discrepancy(largest_ring) * static_cast<double>(largest_ring) / 1000.0;
      EXPECT_NEAR(static_cast<double>(above) / 1000.0, expected, error) << elevation_deg;
    }
}

TEST(SkyPartition, AHalfPlaneHidesAHalfWhateverItsAzimuth) {
  for (const SkyWeight weight : partition_weights)
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
      const SkyPartition sky(weight, 1000);
      const Point2d towards{sin(Angle::degrees(azimuth_deg)), cos(Angle::degrees(azimuth_deg))};
      std::size_t seen = 0;
      for (const Point3d& d : sky.directions()) seen += dot(horizontal(d), towards) > 0.0 ? 1U : 0U;
      // n directions at equal distances have n/2 in a half circle, give or take one
      EXPECT_NEAR(static_cast<double>(seen), 500.0, static_cast<double>(sky.ring_count())) << azimuth_deg;
    }
}

}  // namespace
}  // namespace farlod
