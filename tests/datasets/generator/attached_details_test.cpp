// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "generator/building_solid.hpp"
#include "generator/convex_faces.hpp"
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

class FacadeDetails : public ::testing::Test {
 protected:
  static std::vector<GeneratedBuilding> buildings() {
    CitySettings settings = detailed_city();
    settings.facade_details = true;
    return all_buildings(settings);
  }
};

/// How far a window or door stands behind its wall; both are upright and along the axes.
std::int64_t set_back_mm(const GeneratedBuilding& building, const GeneratedFacet& filling) {
  const PointMm area = twice_area_mm2(filling.outer, building.vertices);
  const PointMm to_wall = building.vertices[building.facets[filling.in_wall].outer[0]] - building.vertices[filling.outer[0]];
  if (area.x != 0) return area.x > 0 ? to_wall.x : -to_wall.x;
  return area.y > 0 ? to_wall.y : -to_wall.y;
}

TEST_F(FacadeDetails, EachOpeningIsFilledFlushOrSetBack) {
  std::map<std::int64_t, int> depths;
  std::map<Filling, int> fillings;
  for (const GeneratedBuilding& building : buildings()) {
    std::map<std::size_t, std::size_t> filled;
    int doors = 0;
    for (const GeneratedFacet& facet : building.facets) {
      if (facet.filling == Filling::none) continue;
      ++filled[facet.in_wall];
      ++fillings[facet.filling];
      doors += facet.filling == Filling::door ? 1 : 0;
      ++depths[set_back_mm(building, facet)];
      EXPECT_EQ(facet.role, FacetRole::wall);
    }
    EXPECT_LE(doors, 1) << building.id;
    for (std::size_t k = 0; k < building.facets.size(); ++k)
      EXPECT_EQ(building.facets[k].openings.size(), filled.contains(k) ? filled[k] : 0U) << building.id;
  }
  EXPECT_EQ(depths.size(), 2U);
  EXPECT_GT(depths[0], 1000);
  EXPECT_GT(depths[120], 1000);
  EXPECT_GT(fillings[Filling::window], 10'000);
  EXPECT_GT(fillings[Filling::door], 500);
}

TEST_F(FacadeDetails, NoWindowLooksAtATouchingNeighbor) {
  CitySettings open = detailed_city();
  open.facade_details = open.open_shells = true;
  // Walls with openings are never cut, since no neighbor touches them: cutting the others leaves all windows
  const std::vector<GeneratedBuilding> before = buildings(), after = all_buildings(open);
  CitySettings plain = detailed_city();
  plain.open_shells = true;
  const std::vector<GeneratedBuilding> expected = all_buildings(plain);
  const auto wall_area = [](const GeneratedBuilding& building) {
    const GeneratedComponent& body = building.components.front();
    std::int64_t twice_mm2 = 0;
    for (const GeneratedFacet& facet : facets_of(building, body)) {
      // Reveals are in pairs that look at each other, and do not count
      if (facet.role != FacetRole::wall) continue;
      const PointMm area = twice_area_mm2(facet.outer, building.vertices);
      PointMm cut;
      for (const RingNumbers& opening : facet.openings) cut = cut + twice_area_mm2(opening, building.vertices);
      twice_mm2 += area.x + cut.x + 3 * (area.y + cut.y);
    }
    return twice_mm2;
  };
  ASSERT_EQ(after.size(), expected.size());
  for (std::size_t k = 0; k < after.size(); ++k) EXPECT_EQ(wall_area(after[k]), wall_area(expected[k])) << after[k].id;
}

TEST_F(FacadeDetails, FacesOfWallsCoverThemButForTheirOpenings) {
  int walls = 0;
  CitySettings turned = detailed_city();
  turned.facade_details = true, turned.rotation_deg = 37.0;
  for (const GeneratedBuilding& building : all_buildings(turned))
    for (const GeneratedFacet& facet : building.facets) {
      if (facet.openings.empty()) continue;
      ++walls;
      PointMm expected = twice_area_mm2(facet.outer, building.vertices), found;
      for (const RingNumbers& opening : facet.openings) expected = expected + twice_area_mm2(opening, building.vertices);
      for (const FaceRing& face : convex_faces(facet, building.vertices)) {
        EXPECT_EQ(face.size(), 3U);
        found = found + twice_area_mm2(face, building.vertices);
      }
      ASSERT_EQ(found, expected) << building.id;
    }
  EXPECT_GT(walls, 1000);
}

TEST_F(FacadeDetails, LowAndHighStoreysHaveWindowsThatDoNotOverlap) {
  for (const double scale : {0.25, 0.6, 4.0}) {
    CitySettings settings = detailed_city();
    settings.facade_details = true, settings.height_scale = scale, settings.size_m = 400.0;
    for (const GeneratedBuilding& building : all_buildings(settings))
      for (const GeneratedFacet& facet : building.facets)
        for (std::size_t a = 0; a < facet.openings.size(); ++a)
          for (std::size_t b = a + 1; b < facet.openings.size(); ++b) {
            const GeneratedFacet first{.outer = facet.openings[a]}, second{.outer = facet.openings[b]};
            const BoxMm p = box_of(building, std::span(&first, 1)), q = box_of(building, std::span(&second, 1));
            const bool apart_x = p.high.x < q.low.x || q.high.x < p.low.x, apart_y = p.high.y < q.low.y || q.high.y < p.low.y;
            ASSERT_TRUE(apart_x || apart_y || p.high.z < q.low.z || q.high.z < p.low.z) << building.id;
          }
  }
}

TEST_F(FacadeDetails, ChimneysAndDormersComeOutOfTheRoof) {
  int chimneys = 0, dormers = 0;
  for (const GeneratedBuilding& building : buildings()) {
    const BoxMm house = box_of(building, facets_of(building, building.components.front()));
    for (const GeneratedComponent& c : building.components) {
      if (c.kind == ComponentKind::body) continue;
      const bool is_chimney = c.id.ends_with("_chimney");
      const BoxMm box = box_of(building, facets_of(building, c));
      EXPECT_TRUE(house.low.x <= box.low.x && box.high.x <= house.high.x) << c.id;
      EXPECT_TRUE(house.low.y <= box.low.y && box.high.y <= house.high.y) << c.id;
      EXPECT_GT(box.low.z, house.low.z);
      if (is_chimney) {
        EXPECT_EQ(box.high.z, house.high.z + 800) << c.id;
      } else {
        EXPECT_LT(box.high.z, house.high.z) << c.id;
      }
      (is_chimney ? chimneys : dormers) += 1;
    }
  }
  EXPECT_GT(chimneys, 100);
  EXPECT_GT(dormers, 100);
}

constexpr std::int64_t eaves_mm = 600;

CitySettings city_with_eaves(double eaves_m) {
  CitySettings settings;
  settings.size_m = 900.0, settings.lod = 2, settings.eaves_m = eaves_m;
  return settings;
}

struct RoofBorder {
  std::array<std::int64_t, 4> beyond_mm;  ///< west, south, east, north of the walls
};

RoofBorder border_of(const GeneratedBuilding& building) {
  const BoxMm roof = box_of(building, facets_with(building, FacetRole::roof));
  const BoxMm walls = box_of(building, facets_with(building, FacetRole::wall));
  return {{walls.low.x - roof.low.x, walls.low.y - roof.low.y, roof.high.x - walls.high.x, roof.high.y - walls.high.y}};
}

TEST(Eaves, ProjectByWhatIsAskedForWhereNoNeighborTouches) {
  int free_standing = 0, one_sided = 0;
  for (const GeneratedBuilding& building : all_buildings(city_with_eaves(0.6))) {
    if (building.components.front().closed) {
      for (const std::int64_t mm : border_of(building).beyond_mm) EXPECT_EQ(mm, 0) << building.id;
      continue;
    }
    const auto sides = border_of(building).beyond_mm;
    for (const std::int64_t mm : sides) EXPECT_TRUE(mm == 0 || mm == eaves_mm) << building.id << ' ' << mm;
    const auto projecting = std::ranges::count(sides, eaves_mm);
    if (building.kind == BuildingKind::detached || building.kind == BuildingKind::pavilion) {
      EXPECT_EQ(projecting, 4) << building.id;
    }
    free_standing += projecting == 4 ? 1 : 0;
    one_sided += projecting < 4 ? 1 : 0;
  }
  EXPECT_GT(free_standing, 100);
  EXPECT_GT(one_sided, 100);
}

/// No roof hangs over the neighbor that its own wall touches.
TEST(Eaves, DoNotReachIntoTouchingBuildings) {
  const CitySettings settings = city_with_eaves(0.6);
  const CityLayout layout(settings);
  int pairs = 0;
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    const std::vector<GeneratedBuilding> block = buildings_of_block(settings, layout.block_at(k));
    for (const GeneratedBuilding& a : block)
      for (const GeneratedBuilding& b : block) {
        if (&a == &b || a.footprint.size() > 4 || b.footprint.size() > 4) continue;
        const BoxMm own = box_of(a, facets_with(a, FacetRole::wall)), other = box_of(b, facets_with(b, FacetRole::wall));
        const bool touches_east = own.high.x == other.low.x && own.low.y < other.high.y && other.low.y < own.high.y;
        if (!touches_east) continue;
        ++pairs;
        EXPECT_LE(box_of(a, facets_with(a, FacetRole::roof)).high.x, other.low.x) << a.id << " over " << b.id;
        EXPECT_GE(box_of(b, facets_with(b, FacetRole::roof)).low.x, own.high.x) << b.id << " over " << a.id;
      }
  }
  EXPECT_GT(pairs, 50);
}

/// Distance of a point from a facet's plane.
double from_plane_mm(const PointMm& p, const GeneratedFacet& facet, const GeneratedBuilding& building) {
  const Point3d normal = normalized(as_double(twice_area_mm2(facet.outer, building.vertices)));
  return std::abs(dot(normal, as_double(p - building.vertices[facet.outer[0]])));
}

TEST(Eaves, AreTheRoofsOwnPlanes) {
  const std::vector<GeneratedBuilding> before = all_buildings(city_with_eaves(0.0)), after = all_buildings(city_with_eaves(0.6));
  ASSERT_EQ(before.size(), after.size());
  // The plane through three corners that are each off by √3/2 mm moves by more beyond them, at most three times here
  constexpr double tolerance_mm = 2.0 * 3.0 * planarity_mm;
  int hipped = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const std::vector<GeneratedFacet> old_roof = facets_with(before[k], FacetRole::roof);
    const std::vector<GeneratedFacet> roof = facets_with(after[k], FacetRole::roof);
    ASSERT_EQ(old_roof.size(), roof.size()) << before[k].id;
    hipped += std::ranges::any_of(old_roof, [](const auto& f) { return f.outer.size() == 3; }) ? 1 : 0;
    for (const GeneratedFacet& facet : old_roof) {
      double nearest_mm = 1e9;
      for (const GeneratedFacet& wide : roof) {
        double farthest_mm = 0.0;
        for (const std::uint32_t v : facet.outer)
          farthest_mm = std::max(farthest_mm, from_plane_mm(before[k].vertices[v], wide, after[k]));
        nearest_mm = std::min(nearest_mm, farthest_mm);
      }
      EXPECT_LE(nearest_mm, tolerance_mm) << before[k].id;
    }
  }
  EXPECT_GT(hipped, 50);
}

TEST(Eaves, CoverTheirOutlineOnce) {
  for (const GeneratedBuilding& building : all_buildings(city_with_eaves(0.6))) {
    if (building.components.front().closed || building.footprint.size() != 4) continue;
    std::int64_t twice_covered_mm2 = 0;
    const std::vector<GeneratedFacet> roof = facets_with(building, FacetRole::roof);
    for (const GeneratedFacet& facet : roof) twice_covered_mm2 += twice_area_mm2(facet.outer, building.vertices).z;
    const BoxMm box = box_of(building, roof);
    const std::int64_t width_mm = box.high.x - box.low.x, depth_mm = box.high.y - box.low.y;
    // The ends of ridges and hips round by half a millimetre
    EXPECT_LE(std::abs(twice_covered_mm2 / 2 - width_mm * depth_mm), width_mm + depth_mm) << building.id;
  }
}

TEST(Eaves, LeaveTheWallsAlone) {
  const std::vector<GeneratedBuilding> before = all_buildings(city_with_eaves(0.0)), after = all_buildings(city_with_eaves(0.6));
  for (std::size_t k = 0; k < before.size(); ++k) {
    const auto walls = [](const GeneratedBuilding& building) {
      std::vector<PointMm> corners;
      for (const GeneratedFacet& facet : building.facets)
        if (facet.role != FacetRole::roof)
          for (const std::uint32_t v : facet.outer) corners.push_back(building.vertices[v]);
      return corners;
    };
    EXPECT_EQ(walls(before[k]), walls(after[k])) << before[k].id;
  }
}

}  // namespace
}  // namespace farlod
