// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "run/memory_limit.hpp"

namespace farlod {
namespace {

/// Blocks of 1 km, and crowns of a million bytes.
package::Manifest city_of(std::int32_t columns, std::int32_t rows) {
  package::Manifest manifest;
  manifest.grid.cell_edge_m = 100.0;
  manifest.grid.block_edge = 10;
  manifest.grid.cells = {0, 0, columns, rows};
  manifest.canopy.emplace();
  manifest.canopy->stamp.bytes = 1'000'000;
  return manifest;
}

TEST(CrownsAtWork, AreNoneWithoutTrees) {
  package::Manifest manifest = city_of(80, 80);
  manifest.canopy.reset();
  EXPECT_EQ(bytes_of_crowns_at_work(manifest), 0.0);
}

TEST(CrownsAtWork, OfASmallCityAreAll) { EXPECT_EQ(bytes_of_crowns_at_work(city_of(80, 80)), 1e6); }

// Two blocks and 3 km on both sides are 8 km
TEST(CrownsAtWork, OfALargeCityAreThoseAroundFourBlocks) {
  EXPECT_NEAR(bytes_of_crowns_at_work(city_of(320, 320)), 1e6 * 2.0 / 16.0, 1e-6);
  EXPECT_NEAR(bytes_of_crowns_at_work(city_of(320, 20)), 1e6 * 2.0 / 4.0, 1e-6);
}

}  // namespace
}  // namespace farlod
