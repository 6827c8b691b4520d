// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/datasets/generator/solid_geometry.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "generator/generated_city.hpp"

namespace farlod {
namespace {

double thickness_along(const Point3d& unit_normal, std::span<const PointMm> points) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PointMm& p : points) {
    const double height = dot(unit_normal, as_double(p - points.front()));
    low = std::min(low, height), high = std::max(high, height);
  }
  return high - low;
}

}  // namespace

std::vector<RingNumbers> rings_of(const GeneratedBuilding& building) {
  std::vector<RingNumbers> rings;
  for (const GeneratedComponent& component : building.components)
    for (RingNumbers& ring : rings_of(building, component)) rings.push_back(std::move(ring));
  return rings;
}

std::vector<RingNumbers> rings_of(const GeneratedBuilding& building, const GeneratedComponent& component) {
  std::vector<RingNumbers> rings;
  for (const GeneratedFacet& facet : facets_of(building, component)) {
    rings.push_back(facet.outer);
    if (!facet.hole.empty()) rings.push_back(facet.hole);
    rings.insert(rings.end(), facet.openings.begin(), facet.openings.end());
  }
  return rings;
}

std::vector<GeneratedFacet> facets_with(const GeneratedBuilding& building, FacetRole role) {
  std::vector<GeneratedFacet> result;
  std::ranges::copy_if(building.facets, std::back_inserter(result), [role](const auto& facet) { return facet.role == role; });
  return result;
}

std::span<const GeneratedFacet> facets_of(const GeneratedBuilding& building, const GeneratedComponent& component) {
  return std::span(building.facets).subspan(component.first_facet, component.facet_count);
}

bool is_closed(std::span<const RingNumbers> rings) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const RingNumbers& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) ++uses[{ring[k], ring[(k + 1) % ring.size()]}];
  return std::ranges::all_of(uses, [&uses](const auto& use) {
    const auto opposite = uses.find({use.first.second, use.first.first});
    return use.second == 1 && opposite != uses.end() && opposite->second == 1;
  });
}

std::int64_t six_volumes_mm3(std::span<const RingNumbers> rings, std::span<const PointMm> vertices) {
  std::int64_t sum = 0;
  for (const RingNumbers& ring : rings)
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const PointMm a = vertices[ring[0]] - vertices[0], b = vertices[ring[k]] - vertices[0],
                    c = vertices[ring[k + 1]] - vertices[0];
      sum += dot(a, cross(b, c));
    }
  return sum;
}

PointMm twice_area_mm2(const RingNumbers& ring, std::span<const PointMm> vertices) {
  PointMm sum;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    sum = sum + cross(vertices[ring[k]] - vertices[ring[0]], vertices[ring[k + 1]] - vertices[ring[0]]);
  return sum;
}

double least_thickness_mm(std::span<const PointMm> points) {
  std::vector<Point3d> lines;
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b) lines.push_back(as_double(points[b] - points[a]));
  double least = std::numeric_limits<double>::infinity();
  for (const Point3d& l : lines)
    for (const Point3d& m : lines) {
      const Point3d normal = normalized(cross(l, m));
      if (norm(normal) > 0.5) least = std::min(least, thickness_along(normal, points));
    }
  return least;
}

std::int64_t twice_area_mm2(std::span<const PlanPointMm> ring) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const PlanPointMm &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

std::vector<GeneratedBuilding> all_buildings(const CitySettings& settings) {
  std::vector<GeneratedBuilding> result;
  visit_city(settings, {.building = [&result](const GeneratedBuilding& building) { result.push_back(building); }});
  return result;
}

std::vector<CitySettings> cities_of_all_shapes() {
  CitySettings blocks, roofs, overhangs, hills;
  blocks.size_m = 1200.0, blocks.rotation_deg = 29.0;
  roofs = blocks, roofs.lod = 2, roofs.rotation_deg = -17.3;
  overhangs = roofs, overhangs.overhangs = true, overhangs.seed = 4, overhangs.rotation_deg = 0.0;
  hills = overhangs, hills.terrain_relief_m = 45.0, hills.rotation_deg = 61.7;
  return {blocks, roofs, overhangs, hills};
}

std::vector<CitySettings> cities_with_each_option() {
  CitySettings plain;
  plain.size_m = 700.0, plain.rotation_deg = 23.0, plain.lod = 2, plain.seed = 6;
  std::vector<CitySettings> cities(9, plain);
  cities[0].open_shells = true;
  cities[1].eaves_m = 0.6;
  cities[2].balconies = true;
  cities[3].projecting_floors = true;
  cities[4].hillside = true;
  cities[5].overlapping_parts = true;
  cities[6].wrong_base_share = 0.3;
  cities[7].facade_details = true;
  CitySettings& all = cities[8];
  CitySettings::describe_switches(all, [](const char*, bool& value, const char*) { value = true; });
  all.eaves_m = 0.6, all.wrong_base_share = 0.3;
  return cities;
}

BoxMm box_of(const GeneratedBuilding& building, std::span<const GeneratedFacet> facets) {
  const PointMm first = building.vertices[facets.front().outer.front()];
  BoxMm box{first, first};
  for (const GeneratedFacet& facet : facets)
    for (const std::uint32_t k : facet.outer) {
      const PointMm& p = building.vertices[k];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  return box;
}

}  // namespace farlod
