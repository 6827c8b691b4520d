// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "generator/building_solid.hpp"
#include "generator/generated_city.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

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
  const PointMm area = twice_area_mm2(facet.outer, building.vertices), to = p - building.vertices[facet.outer[0]];
  const Point3d normal =
      normalized(Point3d{static_cast<double>(area.x), static_cast<double>(area.y), static_cast<double>(area.z)});
  return std::abs(dot(normal, Point3d{static_cast<double>(to.x), static_cast<double>(to.y), static_cast<double>(to.z)}));
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
