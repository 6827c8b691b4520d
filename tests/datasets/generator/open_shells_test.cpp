// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/open_shells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "generator/generated_city.hpp"
#include "generator/keyed_random.hpp"
#include "tests/datasets/generator/point_in_city.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

CitySettings touching_city(int lod) {
  CitySettings settings;
  settings.size_m = 900.0, settings.lod = lod, settings.seed = 2, settings.hillside = true;
  return settings;
}

CitySettings opened(CitySettings settings) {
  settings.open_shells = true;
  return settings;
}

/// Area of the walls, in square millimetres. Walls are upright, and at a rotation of 0 along the axes.
std::int64_t wall_area_mm2(const GeneratedBuilding& building) {
  std::int64_t twice = 0;
  for (const GeneratedFacet& facet : building.facets) {
    if (facet.role != FacetRole::wall) continue;
    const PointMm area = twice_area_mm2(facet.outer, building.vertices);
    twice += std::abs(area.x) + std::abs(area.y);
  }
  return twice / 2;
}

/// Area that the walls of two prisms share: for each pair of footprint edges that run against each other on one line.
std::int64_t shared_area_mm2(const GeneratedBuilding& a, const GeneratedBuilding& b) {
  const std::int64_t height_mm = std::min(a.top_mm, b.top_mm) - std::max(a.base_mm, b.base_mm);
  std::int64_t length_mm = 0;
  for (std::size_t i = 0; i < a.footprint.size(); ++i)
    for (std::size_t j = 0; j < b.footprint.size(); ++j) {
      const PlanPointMm p = a.footprint[i], q = a.footprint[(i + 1) % a.footprint.size()];
      const PlanPointMm r = b.footprint[j], s = b.footprint[(j + 1) % b.footprint.size()];
      for (const std::size_t along : {0U, 1U}) {
        const std::size_t across = 1 - along;
        if (p[across] != q[across] || r[across] != s[across] || p[across] != r[across]) continue;
        if ((q[along] > p[along]) == (s[along] > r[along])) continue;
        const std::int64_t low = std::max(std::min(p[along], q[along]), std::min(r[along], s[along]));
        const std::int64_t high = std::min(std::max(p[along], q[along]), std::max(r[along], s[along]));
        length_mm += std::max<std::int64_t>(0, high - low);
      }
    }
  return length_mm * std::max<std::int64_t>(0, height_mm);
}

TEST(OpenShells, LoseTheAreaThatPrismsShare) {
  const CitySettings closed = touching_city(1);
  const CityLayout layout(closed);
  std::int64_t removed_mm2 = 0;
  for (std::int64_t k = 0; k < layout.block_count(); ++k) {
    const std::vector<GeneratedBuilding> before = buildings_of_block(closed, layout.block_at(k));
    const std::vector<GeneratedBuilding> after = buildings_of_block(opened(closed), layout.block_at(k));
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t n = 0; n < before.size(); ++n) {
      std::int64_t shared_mm2 = 0;
      for (std::size_t m = 0; m < before.size(); ++m)
        if (m != n) shared_mm2 += shared_area_mm2(before[n], before[m]);
      EXPECT_EQ(wall_area_mm2(before[n]) - wall_area_mm2(after[n]), shared_mm2) << before[n].id;
      removed_mm2 += shared_mm2;
    }
  }
  EXPECT_GT(removed_mm2, std::int64_t{1'000'000} * 10'000) << "less than a hectare of party walls: is anything tested?";
}

using Faces = std::vector<ConvexFace>;

bool any_holds(const std::vector<Faces>& buildings, std::size_t but, const Point3d& p) {
  for (std::size_t k = 0; k < buildings.size(); ++k)
    if (k != but && is_inside(p, buildings[k])) return true;
  return false;
}

/// A point of a face, away from its corners.
Point3d some_point(KeyedRandom& random, const ConvexFace& face) {
  Point3d sum;
  double weights = 0.0;
  for (const Point3d& corner : face.corners) {
    const double weight = random.between(0.1, 1.0);
    sum = sum + weight * corner;
    weights += weight;
  }
  return (1.0 / weights) * sum;
}

/// In the city with roofs: a wall is there where nobody stands against it, and nowhere else.
TEST(OpenShells, KeepWhatIsExposedAndNothingElse) {
  CitySettings closed = touching_city(2);
  closed.rotation_deg = 17.0;
  closed.projecting_floors = true;
  constexpr double outside_mm = 10.0, tolerance_mm = 3.0;
  const CityLayout layout(closed);
  KeyedRandom random({5});
  std::map<bool, int> seen;
  for (std::int64_t block = 0; block < layout.block_count(); ++block) {
    std::vector<Faces> before, after;
    for (const auto& b : buildings_of_block(closed, layout.block_at(block))) before.push_back(convex_faces_of(b));
    for (const auto& b : buildings_of_block(opened(closed), layout.block_at(block))) after.push_back(convex_faces_of(b));
    for (std::size_t n = 0; n < before.size(); ++n)
      for (const ConvexFace& wall : before[n]) {
        if (wall.role != FacetRole::wall) continue;
        const Point3d p = some_point(random, wall), near = p + outside_mm * wall.normal;
        const Point3d along = normalized(cross(wall.normal, Point3d{0, 0, 1})), up{0, 0, 1};
        const bool is_covered = any_holds(before, n, near);
        // Where a cover ends within a few centimetres, rounding decides
        bool is_clear = true;
        for (const Point3d& aside : {40.0 * along, -40.0 * along, 40.0 * up, -40.0 * up})
          is_clear = is_clear && any_holds(before, n, near + aside) == is_covered;
        if (!is_clear) continue;
        ++seen[is_covered];
        const bool is_there = std::ranges::any_of(
            after[n], [&](const ConvexFace& face) { return face.role == FacetRole::wall && is_on(p, face, tolerance_mm); });
        ASSERT_NE(is_there, is_covered) << "block " << block << ", building " << n;
      }
  }
  EXPECT_GT(seen[true], 500);
  EXPECT_GT(seen[false], 5000);
}

TEST(OpenShells, HaveNoFloors) {
  CitySettings settings = opened(touching_city(2));
  settings.overhangs = true;
  int bridges = 0;
  for (const GeneratedBuilding& building : all_buildings(settings)) {
    const bool is_bridge = building.kind == BuildingKind::bridge;
    bridges += is_bridge ? 1 : 0;
    EXPECT_EQ(building.components.front().closed, is_bridge) << building.id;
    for (const GeneratedFacet& facet : building.facets) EXPECT_NE(facet.role, FacetRole::ground) << building.id;
  }
  EXPECT_GT(bridges, 0);
}

TEST(OpenShells, KeepRoofsAndFootprints) {
  const std::vector<GeneratedBuilding> before = all_buildings(touching_city(2)), after = all_buildings(opened(touching_city(2)));
  ASSERT_EQ(before.size(), after.size());
  const auto roofs = [](const GeneratedBuilding& building) {
    std::vector<std::vector<PointMm>> rings;
    for (const GeneratedFacet& facet : building.facets)
      if (facet.role == FacetRole::roof)
        for (auto& ring = rings.emplace_back(); const std::uint32_t k : facet.outer) ring.push_back(building.vertices[k]);
    return rings;
  };
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(roofs(before[k]), roofs(after[k])) << before[k].id;
    EXPECT_EQ(before[k].footprint, after[k].footprint) << before[k].id;
  }
}

}  // namespace
}  // namespace farlod
