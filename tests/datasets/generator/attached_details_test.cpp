// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "generator/generated_city.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

CitySettings detailed_city() {
  CitySettings settings;
  settings.size_m = 900.0, settings.lod = 2, settings.seed = 3;
  return settings;
}

BoxMm footprint_box(const GeneratedBuilding& building) {
  BoxMm box{{building.footprint[0][0], building.footprint[0][1], 0}, {building.footprint[0][0], building.footprint[0][1], 0}};
  for (const PlanPointMm& p : building.footprint) {
    box.low = {std::min(box.low.x, p[0]), std::min(box.low.y, p[1]), 0};
    box.high = {std::max(box.high.x, p[0]), std::max(box.high.y, p[1]), 0};
  }
  return box;
}

TEST(Balconies, AreSlabsThatTouchTheirFacadeFromOutside) {
  CitySettings settings = detailed_city();
  settings.balconies = true;
  int with = 0, without = 0;
  for (const GeneratedBuilding& building : all_buildings(settings)) {
    const bool flats = building.kind == BuildingKind::attached || building.kind == BuildingKind::slab;
    (building.components.size() > 1 ? with : without) += flats ? 1 : 0;
    const BoxMm house = footprint_box(building);
    std::map<std::int64_t, int> floors;
    for (const GeneratedComponent& balcony : building.components) {
      if (balcony.kind == ComponentKind::body) continue;
      EXPECT_TRUE(flats);
      EXPECT_EQ(balcony.kind, ComponentKind::installation);
      const BoxMm slab = box_of(building, facets_of(building, balcony));
      std::set<std::int64_t> edges{slab.high.x - slab.low.x, slab.high.y - slab.low.y};
      EXPECT_EQ(edges, (std::set<std::int64_t>{1200, 3000})) << balcony.id;
      EXPECT_EQ(slab.high.z - slab.low.z, 200) << balcony.id;
      EXPECT_EQ(balcony.facet_count, 6U);
      const bool beside_x = slab.low.x >= house.low.x && slab.high.x <= house.high.x;
      const bool beside_y = slab.low.y >= house.low.y && slab.high.y <= house.high.y;
      const bool meets_x = beside_y && (slab.low.x == house.high.x || slab.high.x == house.low.x);
      const bool meets_y = beside_x && (slab.low.y == house.high.y || slab.high.y == house.low.y);
      EXPECT_TRUE(meets_x != meets_y) << balcony.id;
      ++floors[slab.high.z];
    }
    if (building.components.size() == 1) continue;
    EXPECT_EQ(floors.size(), static_cast<std::size_t>(building.storeys - 1)) << building.id << ": one a storey";
    for (const auto& [z, count] : floors) EXPECT_EQ(count, floors.begin()->second) << building.id;
  }
  EXPECT_GT(with, 50);
  EXPECT_GT(without, 50);
}

}  // namespace
}  // namespace farlod
