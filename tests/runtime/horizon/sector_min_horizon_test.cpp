// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/sector_min_horizon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "farlod/angle.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {
namespace {

constexpr std::size_t sectors = SectorMinHorizon::sectors;

struct alignas(64) Row : std::array<float, lane_count> {};

/// Random slopes, many of them level.
std::vector<Row> random_rows(std::size_t count, RandomPlaces& random) {
  std::vector<Row> rows(count);
  for (Row& row : rows)
    for (float& slope : row) slope = std::max(0.0F, random.between(-0.3, 5.0));
  return rows;
}

SectorMinHorizon floors_of(const std::vector<Row>& rows, const AzimuthRing& ring) {
  SectorMinHorizon floors;
  find_sector_minima(rows.front().data(), ring.first_of_sector(), floors);
  return floors;
}

/// The lowest slope at the azimuths of the sectors from first to last, counted on over the end of the turn.
float judged_floor(const std::vector<Row>& rows, const AzimuthRing& ring, std::size_t first, std::size_t last) {
  float lowest = std::numeric_limits<float>::max();
  for (std::size_t s = first; s <= last; ++s)
    for (std::size_t k = ring.first_of_sector()[s % sectors]; k < ring.first_of_sector()[s % sectors + 1]; ++k)
      lowest = std::min(lowest, *std::min_element(rows[k].begin(), rows[k].end()));
  return lowest;
}

std::set<std::size_t> edges_above(const EdgeReach& reach, const SectorMinHorizon& floors) {
  std::array<std::uint8_t, lane_count> lanes;
  const std::size_t count = edges_above_horizon(reach, floors, lanes);
  return {lanes.begin(), lanes.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(SectorMinHorizon, FindWhatRisesOverSomebodysHorizonInAnySectorThatItTouches) {
  RandomPlaces random;
  std::size_t found = 0;
  for (const std::size_t azimuths : {8U, 96U, 256U}) {
    const AzimuthRing ring = AzimuthRing::even(azimuths, GridRotation(Angle::degrees(20.0)));
    const std::vector<Row> rows = random_rows(azimuths, random);
    const SectorMinHorizon floors = floors_of(rows, ring);
    for (int n = 0; n < 300; ++n) {
      EdgeReach reach;
      std::set<std::size_t> judged;
      for (std::size_t l = 0; l < lane_count; ++l) {
        const float from = random.between(0.0, 1.9), to = from + random.between(0.0, 1.0) * random.between(0.0, 0.99);
        reach.from[l] = from;
        reach.to[l] = to;
        reach.steepest[l] = random.between(-0.5, 0.5);
        const auto sector_at = [](float turns) { return static_cast<std::size_t>(turns * static_cast<float>(sectors)); };
        if (reach.steepest[l] > judged_floor(rows, ring, sector_at(from), sector_at(to))) judged.insert(l);
      }
      EXPECT_EQ(edges_above(reach, floors), judged);
      found += judged.size();
    }
  }
  EXPECT_GT(found, 1000U);
}

TEST(SectorMinHorizon, WhatIsTooNearToTellRisesAnywhere) {
  const AzimuthRing ring = AzimuthRing::even(1, {});
  const SectorMinHorizon floors = floors_of(std::vector<Row>(1), ring);
  EdgeReach reach{broadcast(EdgeReach::anything), broadcast(0.1F), broadcast(2.9F)};
  EXPECT_EQ(edges_above(reach, floors).size(), lane_count);
  reach.steepest = broadcast(-1.0F);
  EXPECT_TRUE(edges_above(reach, floors).empty());
}

}  // namespace
}  // namespace farlod
