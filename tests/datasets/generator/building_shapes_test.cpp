// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "generator/generated_city.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

CitySettings plain_city() {
  CitySettings settings;
  settings.size_m = 1200.0, settings.lod = 2, settings.seed = 4;
  return settings;
}

bool are_same(const GeneratedBuilding& a, const GeneratedBuilding& b) {
  return a.id == b.id && a.vertices == b.vertices && rings_of(a) == rings_of(b);
}

TEST(ProjectingFloors, StandHalfAMetreToTwoMetresOverTheGroundFloor) {
  CitySettings settings = plain_city();
  settings.projecting_floors = true;
  const std::vector<GeneratedBuilding> before = all_buildings(plain_city()), after = all_buildings(settings);
  ASSERT_EQ(before.size(), after.size());
  int all_around = 0, one_side = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    const std::vector<GeneratedFacet> soffits = facets_with(after[k], FacetRole::outer_ceiling);
    if (soffits.empty()) {
      EXPECT_TRUE(are_same(before[k], after[k])) << after[k].id;
      continue;
    }
    const BoxMm ground = box_of(after[k], facets_with(after[k], FacetRole::ground)), upper = box_of(after[k], after[k].facets);
    const BoxMm soffit = box_of(after[k], soffits);
    EXPECT_EQ(soffits.size(), 1U);
    EXPECT_EQ(soffit.low.z, soffit.high.z);
    EXPECT_TRUE(soffit.low.z >= 2000 && soffit.low.z <= 4200) << soffit.low.z;
    EXPECT_EQ(after[k].footprint, before[k].footprint);
    std::vector<std::int64_t> sides{ground.low.x - upper.low.x, ground.low.y - upper.low.y, upper.high.x - ground.high.x,
                                    upper.high.y - ground.high.y};
    const auto projecting = std::ranges::count_if(sides, [](std::int64_t mm) { return mm > 0; });
    EXPECT_TRUE(projecting == 1 || projecting == 4) << after[k].id;
    for (const std::int64_t mm : sides) EXPECT_TRUE(mm == 0 || (mm >= 500 && mm <= 2000)) << after[k].id << ' ' << mm;
    (projecting == 4 ? all_around : one_side) += 1;
  }
  EXPECT_GT(all_around, 50);
  EXPECT_GT(one_side, 50);
}

bool share_volume(const BoxMm& a, const BoxMm& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y && a.low.z < b.high.z &&
         b.low.z < a.high.z;
}

TEST(OverlappingParts, StandInEachOtherOnTheBuildingsGround) {
  CitySettings settings = plain_city();
  settings.overlapping_parts = true;
  const std::vector<GeneratedBuilding> before = all_buildings(plain_city()), after = all_buildings(settings);
  ASSERT_EQ(before.size(), after.size());
  std::array<int, 4> with_parts{};
  for (std::size_t k = 0; k < after.size(); ++k) {
    if (after[k].components.front().kind == ComponentKind::body) {
      EXPECT_TRUE(are_same(before[k], after[k])) << after[k].id;
      continue;
    }
    const std::vector<GeneratedComponent>& parts = after[k].components;
    ASSERT_TRUE(parts.size() == 2 || parts.size() == 3) << after[k].id;
    ++with_parts[parts.size()];
    const BoxMm lot = box_of(before[k], before[k].facets);
    const BoxMm first = box_of(after[k], facets_of(after[k], parts[0])), second = box_of(after[k], facets_of(after[k], parts[1]));
    EXPECT_TRUE(share_volume(first, second)) << after[k].id;
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const BoxMm box = box_of(after[k], facets_of(after[k], parts[n]));
      EXPECT_EQ(parts[n].kind, ComponentKind::part);
      EXPECT_EQ(parts[n].id, after[k].id + "_part_" + std::to_string(n + 1));
      EXPECT_EQ(box.low.z, lot.low.z);
      EXPECT_TRUE(lot.low.x <= box.low.x && lot.low.y <= box.low.y && box.high.x <= lot.high.x && box.high.y <= lot.high.y);
    }
  }
  EXPECT_GT(with_parts[2], 20);
  EXPECT_GT(with_parts[3], 20);
}

TEST(WrongBases, HaveTheirShareAndLeaveTheRoofs) {
  for (const double share : {0.0, 0.2, 1.0}) {
    CitySettings settings = plain_city();
    settings.terrain_relief_m = 60.0;
    const std::vector<GeneratedBuilding> before = all_buildings(settings);
    settings.wrong_base_share = share;
    const std::vector<GeneratedBuilding> after = all_buildings(settings);
    ASSERT_EQ(before.size(), after.size());
    double wrong = 0.0;
    int at_zero = 0, too_low = 0;
    for (std::size_t k = 0; k < after.size(); ++k) {
      if (are_same(before[k], after[k])) continue;
      wrong += 1.0;
      const std::int64_t by_mm = before[k].base_mm - after[k].base_mm;
      EXPECT_TRUE(after[k].base_mm == 0 || (by_mm >= 10'000 && by_mm <= 40'000)) << after[k].id << ' ' << by_mm;
      EXPECT_GE(by_mm, 10'000) << after[k].id;
      (after[k].base_mm == 0 ? at_zero : too_low) += 1;
      EXPECT_EQ(before[k].top_mm, after[k].top_mm);
      EXPECT_EQ(before[k].footprint, after[k].footprint);
      // All corners stay but those of the floor
      for (const PointMm& p : before[k].vertices)
        if (p.z != before[k].base_mm) {
          EXPECT_EQ(std::ranges::count(after[k].vertices, p), 1) << after[k].id;
        }
    }
    const auto all = static_cast<double>(after.size());
    // Five standard deviations of a binomial count, none for never and always
    EXPECT_LE(std::abs(wrong - share * all), 5.0 * std::sqrt(all * share * (1.0 - share))) << wrong << " of " << all;
    if (share > 0.0) {
      EXPECT_GT(at_zero, 20);
      EXPECT_GT(too_low, 20);
    }
  }
}

/// Two houses of a row: they share a wall across the row and stand on one front line.
struct Neighbors {
  BoxMm first, second;
};

std::vector<Neighbors> rows_of_touching_houses(const CitySettings& settings) {
  std::vector<Neighbors> pairs;
  const CityLayout layout(settings);
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    const std::vector<GeneratedBuilding> block = buildings_of_block(settings, layout.block_at(k));
    for (std::size_t n = 0; n + 1 < block.size(); ++n) {
      const BoxMm a = box_of(block[n], block[n].facets), b = box_of(block[n + 1], block[n + 1].facets);
      const bool one_shape = block[n].footprint.size() == 4 && block[n + 1].footprint.size() == 4;
      if (one_shape && a.high.x == b.low.x && a.low.y == b.low.y && a.high.y == b.high.y) pairs.push_back({a, b});
    }
  }
  return pairs;
}

TEST(Hillside, TouchingHousesStandOnTheSlopeEachOnItsOwnBase) {
  CitySettings settings = plain_city();
  settings.hillside = true;
  const std::vector<Neighbors> pairs = rows_of_touching_houses(settings);
  ASSERT_GT(pairs.size(), 200U);
  std::size_t on_a_slope = 0, metres_apart = 0;
  for (const auto& [west, east] : pairs) {
    // The ground rises along (0.96, 0.28) or falls: the lowest corner of both is the south-western or the north-eastern one
    const double rise_m = 1e-3 * static_cast<double>(east.low.z - west.low.z);
    const double from_low_m = 0.96e-3 * static_cast<double>(east.low.x - west.low.x);
    const double from_high_m = 0.96e-3 * static_cast<double>(east.high.x - west.high.x);
    const double slope = rise_m > 0.0 ? rise_m / from_low_m : -rise_m / from_high_m;
    // Both bases are rounded down to a centimetre
    const double rounding = 0.01 / std::min(from_low_m, from_high_m);
    on_a_slope += slope >= 0.10 - rounding && slope <= 0.25 + rounding ? 1 : 0;
    metres_apart += std::abs(rise_m) >= 1.0 ? 1 : 0;
    EXPECT_LE(slope, 0.25 + rounding);
  }
  // Houses on a ridge or in a valley, which come every 96 to 240 m, do not show a slope
  EXPECT_GT(on_a_slope, pairs.size() * 8 / 10);
  EXPECT_GT(metres_apart, pairs.size() / 3);
}

TEST(Hillside, WithoutItNeighborsStandLevel) {
  for (const auto& [west, east] : rows_of_touching_houses(plain_city())) EXPECT_EQ(west.low.z, east.low.z);
}

}  // namespace
}  // namespace farlod
