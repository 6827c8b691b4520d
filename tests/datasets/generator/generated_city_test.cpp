// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/generated_city.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "farlod/error.hpp"
#include "farlod/surface_kind.hpp"
#include "generator/convex_faces.hpp"
#include "generator/generated_building.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

/// FNV-1a over all that a city consists of.
std::uint64_t fingerprint(const CitySettings& settings) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  const auto add = [&hash](std::uint64_t number) {
    for (int k = 0; k < 8; ++k) hash = (hash ^ ((number >> (8 * k)) & 0xFFU)) * 0x100000001B3U;
  };
  for (const GeneratedBuilding& building : all_buildings(settings)) {
    for (const PointMm& p : building.vertices)
      for (const std::int64_t x : {p.x, p.y, p.z}) add(static_cast<std::uint64_t>(x));
    for (const RingNumbers& ring : rings_of(building))
      for (const std::uint32_t k : ring) add(k);
  }
  return hash;
}

TEST(GeneratedCity, SameSettingsSameCity) {
  for (const CitySettings& settings : cities_of_all_shapes()) EXPECT_EQ(fingerprint(settings), fingerprint(settings));
}

TEST(GeneratedCity, EverySettingOfTheCityMatters) {
  CitySettings settings = cities_of_all_shapes()[3];
  std::set<std::uint64_t> seen{fingerprint(settings)};
  ++settings.seed;
  EXPECT_TRUE(seen.insert(fingerprint(settings)).second);
  settings.overhangs = false;
  EXPECT_TRUE(seen.insert(fingerprint(settings)).second);
  CitySettings::describe(settings, [&](std::string_view name, auto& value, SettingRange range, auto&&...) {
    if (name.starts_with("centre")) return;  // the place of the centre is added by the writers
    const auto before = value;
    const double less = std::max(range.low, static_cast<double>(before) * 0.7);
    const bool is_lowest = static_cast<double>(before) == range.low;
    value = static_cast<std::decay_t<decltype(value)>>(is_lowest ? 0.5 * (range.low + range.high) : less);
    EXPECT_TRUE(seen.insert(fingerprint(settings)).second) << name;
    value = before;
  });
}

TEST(GeneratedCity, EverySwitchMatters) {
  CitySettings settings;
  settings.size_m = 600.0, settings.lod = 2;
  std::set<std::uint64_t> seen{fingerprint(settings)};
  CitySettings::describe_switches(settings, [&](const char* name, bool& value, const char*) {
    value = true;
    EXPECT_TRUE(seen.insert(fingerprint(settings)).second) << name;
    EXPECT_EQ(fingerprint(settings), fingerprint(settings)) << name;
    value = false;
  });
}

class EachCity : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Overhangs, EachCity, ::testing::Values(0));
INSTANTIATE_TEST_SUITE_P(AllOptions, EachCity, ::testing::Values(1));

TEST_P(EachCity, BlocksDoNotDependOnTheirOrder) {
  const CitySettings settings = GetParam() == 0 ? cities_of_all_shapes()[2] : cities_with_each_option().back();
  const std::vector<GeneratedBuilding> in_order = all_buildings(settings);
  const CityLayout layout(settings);
  std::size_t end = in_order.size();
  for (std::int64_t k = layout.block_count(); k-- > 0;) {
    const std::vector<GeneratedBuilding> block = buildings_of_block(settings, layout.block_at(k));
    ASSERT_LE(block.size(), end);
    end -= block.size();
    for (std::size_t n = 0; n < block.size(); ++n) {
      EXPECT_EQ(block[n].id, in_order[end + n].id);
      EXPECT_EQ(block[n].vertices, in_order[end + n].vertices);
    }
  }
  EXPECT_EQ(end, 0U);
}

TEST(GeneratedCity, IdsAreUniqueAndDoNotDependOnTheLevelOfDetail) {
  const std::vector<CitySettings> cities = cities_of_all_shapes();
  CitySettings prisms = cities[2];
  prisms.lod = 1;
  const std::vector<GeneratedBuilding> roofs = all_buildings(cities[2]), blocks = all_buildings(prisms);
  ASSERT_EQ(roofs.size(), blocks.size());
  std::set<std::string> ids;
  for (std::size_t k = 0; k < roofs.size(); ++k) {
    EXPECT_TRUE(ids.insert(roofs[k].id).second);
    EXPECT_EQ(roofs[k].id, blocks[k].id);
    EXPECT_EQ(roofs[k].footprint, blocks[k].footprint);
    EXPECT_LE(blocks[k].top_mm, roofs[k].top_mm);
  }
}

TEST(GeneratedCity, RefusesUnusableSettings) {
  CitySettings settings{.tower_share = 2.0};
  EXPECT_THROW(visit_city(settings, {.building = [](const GeneratedBuilding&) {}}), InvalidArgument);
}

TEST(GeneratedCity, TowersComeNearToTheGreatestHeightAndNotAbove) {
  CitySettings settings{.size_m = 3500.0};
  double tallest_m = 0.0;
  for (const GeneratedBuilding& building : all_buildings(settings)) tallest_m = std::max(tallest_m, building.height_m());
  EXPECT_LE(tallest_m, settings.max_height_m);
  EXPECT_GT(tallest_m, 0.9 * settings.max_height_m);
}

TEST(SizeForBuildings, FindsTheSizeBetweenTooFewAndTooMany) {
  const auto count_at = [](double size_m) {
    CitySettings settings{.size_m = size_m};
    return static_cast<std::int64_t>(all_buildings(settings).size());
  };
  for (const std::int64_t wanted : {300, 2000, 5000}) {
    const double size_m = size_for_buildings_m(CitySettings{}, wanted);
    // Sizes are tried in steps of 10 m, and the nearer neighbor of the wanted number wins
    EXPECT_LE(count_at(size_m - 10.0), wanted);
    EXPECT_GE(count_at(size_m + 10.0), wanted);
  }
}

TEST(SizeForBuildings, RefusesWhatNoCityHas) {
  EXPECT_THROW((void)size_for_buildings_m(CitySettings{}, 0), InvalidArgument);
  EXPECT_THROW((void)size_for_buildings_m(CitySettings{}, std::int64_t{1} << 50), InvalidArgument);
}

template <class Check>
void for_each_building_of_all_shapes(Check check_building) {
  for (const CitySettings& settings : cities_of_all_shapes())
    for (const GeneratedBuilding& building : all_buildings(settings)) check_building(building, settings);
}

/// Of the cities of all shapes, and of those with each option.
template <class Check>
void for_each_component(Check check_component) {
  std::vector<CitySettings> cities = cities_of_all_shapes();
  for (const CitySettings& settings : cities_with_each_option()) cities.push_back(settings);
  for (const CitySettings& settings : cities)
    for (const GeneratedBuilding& building : all_buildings(settings))
      for (const GeneratedComponent& component : building.components) check_component(building, component, settings);
}

TEST(GeneratedBuilding, IsClosed) {
  for_each_building_of_all_shapes([](const GeneratedBuilding& building, const CitySettings&) {
    ASSERT_EQ(building.components.size(), 1U);
    ASSERT_TRUE(building.components.front().closed);
    ASSERT_TRUE(is_closed(rings_of(building))) << building.id;
  });
}

TEST(GeneratedBuilding, ComponentsAreClosedWhereTheySaySo) {
  for_each_component([](const GeneratedBuilding& building, const GeneratedComponent& component, const CitySettings&) {
    ASSERT_EQ(is_closed(rings_of(building, component)), component.closed) << component.id;
  });
}

TEST(GeneratedBuilding, OnlyOpenShellsAndEavesAreNotClosed) {
  for_each_component([](const GeneratedBuilding& building, const GeneratedComponent& component, const CitySettings& settings) {
    const bool may_be_open = settings.open_shells || settings.eaves_m > 0.0;
    if (!may_be_open || component.kind == ComponentKind::installation || building.kind == BuildingKind::bridge) {
      ASSERT_TRUE(component.closed) << component.id;
    }
  });
}

TEST(GeneratedBuilding, LooksOutwards) {
  for_each_component([](const GeneratedBuilding& building, const GeneratedComponent& component, const CitySettings&) {
    if (!component.closed) return;
    ASSERT_GT(six_volumes_mm3(rings_of(building, component), building.vertices), 0) << component.id;
  });
}

TEST(GeneratedBuilding, ComponentsHoldAllFacetsAndShareNoVertex) {
  for_each_component([](const GeneratedBuilding& building, const GeneratedComponent& component, const CitySettings&) {
    if (&component != &building.components.front()) return;
    std::size_t facets = 0;
    std::set<std::uint32_t> of_others;
    for (const GeneratedComponent& c : building.components) {
      ASSERT_EQ(c.first_facet, facets) << c.id;
      facets += c.facet_count;
      std::set<std::uint32_t> own;
      for (const RingNumbers& ring : rings_of(building, c)) own.insert(ring.begin(), ring.end());
      for (const std::uint32_t k : own) ASSERT_TRUE(of_others.insert(k).second) << c.id;
    }
    ASSERT_EQ(facets, building.facets.size());
    ASSERT_EQ(of_others.size(), building.vertices.size());
  });
}

TEST(GeneratedBuilding, FacetsArePlanarToWhatRoundingSpends) {
  for_each_component([](const GeneratedBuilding& building, const GeneratedComponent& component, const CitySettings&) {
    for (const GeneratedFacet& facet : facets_of(building, component)) {
      // The corners of openings are many, and the search is slow: a few stand for all
      std::vector<PointMm> points;
      for (const std::uint32_t k : facet.outer) points.push_back(building.vertices[k]);
      for (const std::uint32_t k : facet.hole) points.push_back(building.vertices[k]);
      if (!facet.openings.empty()) points.push_back(building.vertices[facet.openings.back()[2]]);
      ASSERT_LE(least_thickness_mm(points), 2.0 * planarity_mm) << component.id;
    }
  });
}

TEST(GeneratedBuilding, VerticesAndFacetsAreNotDegenerate) {
  for_each_component([](const GeneratedBuilding& building, const GeneratedComponent& component, const CitySettings&) {
    std::set<std::uint32_t> numbers;
    for (const RingNumbers& ring : rings_of(building, component)) {
      numbers.insert(ring.begin(), ring.end());
      ASSERT_EQ(std::set(ring.begin(), ring.end()).size(), ring.size()) << component.id;
      ASSERT_NE(twice_area_mm2(ring, building.vertices), PointMm{}) << component.id;
    }
    std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> places;
    for (const std::uint32_t k : numbers) {
      const PointMm& p = building.vertices[k];
      ASSERT_TRUE(places.insert({p.x, p.y, p.z}).second) << component.id;
    }
  });
}

TEST(GeneratedBuilding, RolesAgreeWithTheNormals) {
  for_each_building_of_all_shapes([](const GeneratedBuilding& building, const CitySettings&) {
    for (const GeneratedFacet& facet : building.facets) {
      const Point3d normal = normalized(as_double(twice_area_mm2(facet.outer, building.vertices)));
      const bool looks_down = facet.role == FacetRole::ground || facet.role == FacetRole::outer_ceiling;
      const SurfaceKind expected = looks_down                      ? SurfaceKind::floor
                                   : facet.role == FacetRole::wall ? SurfaceKind::wall
                                                                   : SurfaceKind::roof;
      EXPECT_EQ(kind_of_normal(normal), expected) << building.id;
    }
  });
}

TEST(GeneratedBuilding, RoofsCoverTheFootprint) {
  for_each_building_of_all_shapes([](const GeneratedBuilding& building, const CitySettings&) {
    std::int64_t covered_mm2 = 0;
    for (const GeneratedFacet& facet : building.facets) {
      if (facet.role != FacetRole::roof) continue;
      covered_mm2 += twice_area_mm2(facet.outer, building.vertices).z;
      if (!facet.hole.empty()) covered_mm2 += twice_area_mm2(facet.hole, building.vertices).z;
    }
    const std::int64_t footprint_mm2 = twice_area_mm2(building.footprint) + twice_area_mm2(building.footprint_hole);
    EXPECT_GT(footprint_mm2, 0);
    if (building.footprint_hole.empty() || building.kind == BuildingKind::courtyard) {
      // A gable's peak may leave its wall's line by a millimetre, along the whole width of the building
      std::int64_t perimeter_mm = 0;
      for (std::size_t k = 0; k < building.footprint.size(); ++k) {
        const PlanPointMm &a = building.footprint[k], &b = building.footprint[(k + 1) % building.footprint.size()];
        perimeter_mm += std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
      }
      EXPECT_LE(std::abs(covered_mm2 - footprint_mm2), 2 * perimeter_mm) << building.id;
    }
  });
}

TEST(GeneratedBuilding, HeightsAreThoseOfTheSolid) {
  for_each_building_of_all_shapes([](const GeneratedBuilding& building, const CitySettings& settings) {
    const auto [low, high] = std::ranges::minmax(building.vertices, {}, &PointMm::z);
    EXPECT_EQ(low.z, building.base_mm);
    EXPECT_EQ(high.z, building.top_mm);
    if (settings.terrain_relief_m == 0.0 && building.kind != BuildingKind::bridge) {
      EXPECT_EQ(building.base_mm, 0);
    }
    if (building.kind == BuildingKind::bridge) {
      EXPECT_GT(building.base_mm, 0);
    }
  });
}

TEST(GeneratedBuilding, WallsRunAlongTheStreets) {
  for (const CitySettings& settings : cities_of_all_shapes()) {
    // The length-weighted mean direction modulo 90°, from the fourth power of each wall's direction
    double real = 0.0, imaginary = 0.0, length_mm = 0.0, edges = 0.0;
    for (const GeneratedBuilding& building : all_buildings(settings)) {
      for (std::size_t k = 0; k < building.footprint.size(); ++k) {
        const PlanPointMm &a = building.footprint[k], &b = building.footprint[(k + 1) % building.footprint.size()];
        const double east = static_cast<double>(b[0] - a[0]), north = static_cast<double>(b[1] - a[1]);
        const double bearing = std::atan2(east, north), length = std::hypot(east, north);
        real += length * std::cos(4.0 * bearing), imaginary += length * std::sin(4.0 * bearing);
        length_mm += length, edges += 1.0;
      }
    }
    const double turned = 0.25 * std::atan2(imaginary, real) - settings.rotation_deg * std::numbers::pi / 180.0;
    // Rounding moves each end of a wall by at most √½ mm: the sum of length × angle by at most √2 mm a wall
    const double bound = std::numbers::sqrt2 * edges / length_mm;
    EXPECT_LE(std::abs(std::sin(2.0 * turned)), 2.0 * bound) << settings.rotation_deg;
  }
}

TEST(GeneratedBuilding, EveryShapeOfRoofAndOverhangOccurs) {
  int ceilings = 0, holes = 0, pentagons = 0, hexagons = 0, triangles = 0;
  for_each_building_of_all_shapes([&](const GeneratedBuilding& building, const CitySettings&) {
    for (const GeneratedFacet& facet : building.facets) {
      ceilings += facet.role == FacetRole::outer_ceiling ? 1 : 0;
      holes += facet.hole.empty() ? 0 : 1;
      triangles += facet.outer.size() == 3 ? 1 : 0;
      pentagons += facet.outer.size() == 5 ? 1 : 0;
      hexagons += facet.outer.size() == 6 ? 1 : 0;
    }
  });
  for (const int count : {ceilings, holes, triangles, pentagons, hexagons}) EXPECT_GT(count, 0);
}

/// Whether no corner of the face turns against its sense by more than rounding can do: a corner moves by at most √3/2 mm, so
/// that the cross product of two edges changes by at most √3 mm times their lengths, plus the product of the two changes.
bool is_convex(const FaceRing& face, std::span<const PointMm> vertices) {
  const Point3d sense = normalized(as_double(twice_area_mm2(face, vertices)));
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Point3d a = as_double(vertices[face[(k + 1) % face.size()]] - vertices[face[k]]);
    const Point3d b = as_double(vertices[face[(k + 2) % face.size()]] - vertices[face[(k + 1) % face.size()]]);
    const double change_mm = 2.0 * planarity_mm;
    if (dot(cross(a, b), sense) < -change_mm * (norm(a) + norm(b) + change_mm)) return false;
  }
  return true;
}

TEST(ConvexFaces, AreConvexClosedAndOfTheSameVolume) {
  for (const CitySettings& settings : cities_of_all_shapes())
    for (const GeneratedBuilding& building : all_buildings(settings)) {
      std::vector<FaceRing> faces;
      for (const GeneratedFacet& facet : building.facets)
        for (FaceRing& face : convex_faces(facet, building.vertices)) faces.push_back(std::move(face));
      for (const FaceRing& face : faces) ASSERT_TRUE(is_convex(face, building.vertices)) << building.id;
      ASSERT_TRUE(is_closed(faces)) << building.id;
      ASSERT_GT(six_volumes_mm3(faces, building.vertices), 0) << building.id;
    }
}

TEST(ConvexFaces, AFrameBecomesOneFaceForEachSide) {
  const std::vector<PointMm> vertices{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}};
  const std::vector<FaceRing> faces = convex_faces({FacetRole::roof, {0, 1, 2, 3}, {4, 5, 6, 7}}, vertices);
  EXPECT_EQ(faces, (std::vector<FaceRing>{{0, 1, 7, 4}, {1, 2, 6, 7}, {2, 3, 5, 6}, {3, 0, 4, 5}}));
}

TEST(ConvexFaces, AnLBecomesTwo) {
  const std::vector<PointMm> vertices{{0, 0, 0}, {9, 0, 0}, {9, 3, 0}, {3, 3, 0}, {3, 9, 0}, {0, 9, 0}};
  EXPECT_EQ(convex_faces({FacetRole::roof, {0, 1, 2, 3, 4, 5}, {}}, vertices),
            (std::vector<FaceRing>{{3, 4, 5, 0}, {3, 0, 1, 2}}));
}

}  // namespace
}  // namespace farlod
