// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/sky_partition.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "base/frame.hpp"

namespace farlod {
namespace {

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
