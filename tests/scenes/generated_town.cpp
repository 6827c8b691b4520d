// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/generated_town.hpp"

#include <vector>

#include "generator/generated_city.hpp"

namespace farlod::scenes {
namespace {

SurfaceKind kind_of(FacetRole role) {
  switch (role) {
    case FacetRole::roof:
      return SurfaceKind::roof;
    case FacetRole::wall:
      return SurfaceKind::wall;
    case FacetRole::ground:
    case FacetRole::outer_ceiling:
      break;
  }
  return SurfaceKind::floor;
}

void add_ring(CityModel& city, const GeneratedBuilding& building, const std::vector<std::uint32_t>& ring) {
  std::vector<Point3d> points;
  for (const std::uint32_t v : ring) {
    const auto& p = building.vertices[v];
    points.push_back({1e-3 * static_cast<double>(p.x), 1e-3 * static_cast<double>(p.y), 1e-3 * static_cast<double>(p.z)});
  }
  city.add_ring(points);
}

}  // namespace

CityModel generated_town(const CitySettings& settings) {
  CityModel city;
  visit_city(settings, {[&city](const GeneratedBuilding& building) {
               city.begin_building(building.id);
               std::uint32_t surface = 0;
               for (const GeneratedFacet& facet : building.facets) {
                 city.begin_facet(kind_of(facet.role), surface++);
                 add_ring(city, building, facet.outer);
                 if (!facet.hole.empty()) add_ring(city, building, facet.hole);
               }
             }});
  return city;
}

}  // namespace farlod::scenes
