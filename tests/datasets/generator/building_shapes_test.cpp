// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "generator/building_details.hpp"
#include "generator/convex_faces.hpp"
#include "generator/generated_building.hpp"
#include "generator/generated_city.hpp"
#include "generator/keyed_random.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

/// A convex face of a building, in millimetres of the city frame.
struct ConvexFace {
  FacetRole role;
  std::vector<Point3d> corners;
  Point3d normal;  ///< of length 1, outwards
};

double turn(const Point3d& a, const Point3d& b, const Point3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Seen from above; the face may look up or down.
bool covers(const ConvexFace& face, const Point3d& p) {
  const double sign = face.normal.z > 0.0 ? 1.0 : -1.0;
  for (std::size_t k = 0; k < face.corners.size(); ++k)
    if (sign * turn(face.corners[k], face.corners[(k + 1) % face.corners.size()], p) < 0.0) return false;
  return true;
}

std::vector<ConvexFace> convex_faces_of(const GeneratedBuilding& building) {
  std::vector<ConvexFace> faces;
  for (const GeneratedFacet& facet : building.facets)
    for (const FaceRing& ring : convex_faces(facet, building.vertices)) {
      ConvexFace& face = faces.emplace_back();
      face.role = facet.role;
      for (const std::uint32_t k : ring) face.corners.push_back(as_double(building.vertices[k]));
      Point3d sum;
      for (std::size_t k = 1; k + 1 < ring.size(); ++k)
        sum = sum + cross(face.corners[k] - face.corners[0], face.corners[k + 1] - face.corners[0]);
      face.normal = normalized(sum);
    }
  return faces;
}

/// Whether a point is inside a closed building: whether a ray upwards leaves it once more than it enters it.
bool is_inside(const Point3d& p, const std::vector<ConvexFace>& building) {
  // Upright faces count for nothing: the ray runs along them
  constexpr double upright = 1e-3;
  int crossings = 0;
  for (const ConvexFace& face : building) {
    if (std::abs(face.normal.z) < upright || !covers(face, p)) continue;
    const double height_mm = dot(face.normal, face.corners[0] - p) / face.normal.z;
    if (height_mm > 0.0) crossings += face.normal.z > 0.0 ? 1 : -1;
  }
  return crossings > 0;
}

/// Whether a point lies on a face, up to so many millimetres.
bool is_on(const Point3d& p, const ConvexFace& face, double tolerance_mm) {
  if (std::abs(dot(face.normal, p - face.corners[0])) > tolerance_mm) return false;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Point3d edge = normalized(face.corners[(k + 1) % face.corners.size()] - face.corners[k]);
    if (dot(cross(edge, p - face.corners[k]), face.normal) < -tolerance_mm) return false;
  }
  return true;
}

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
