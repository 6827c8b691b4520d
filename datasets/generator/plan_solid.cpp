// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plan_solid.hpp"

#include <algorithm>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// Collects the components of a building. Corners of a component that round to the same millimetres become one vertex, so that
/// neighboring facets share their edges. Two components share no vertex.
class CityBuilder {
 public:
  explicit CityBuilder(const PlanRotation& rotation) : rotation_(rotation) {}

  void add(const PlanSolid& solid, const std::string& id) {
    FARLOD_EXPECTS(!solid.facets.empty());
    ground_mm_ = millimetres(solid.ground_m);
    first_vertex_ = building_.vertices.size();
    GeneratedComponent component{.kind = solid.kind, .id = id + solid.suffix, .closed = solid.closed};
    component.first_facet = building_.facets.size();
    component.facet_count = solid.facets.size();
    for (const PlanFacet& facet : solid.facets) add(facet, component.first_facet);
    component.footprint = ring_in_city(solid.footprint);
    component.footprint_hole = ring_in_city(solid.footprint_hole);
    const auto begin = building_.vertices.begin() + static_cast<std::ptrdiff_t>(first_vertex_);
    const auto [low, high] = std::ranges::minmax_element(begin, building_.vertices.end(), {}, &PointMm::z);
    component.base_mm = low->z;
    component.top_mm = high->z;
    building_.components.push_back(std::move(component));
  }

  [[nodiscard]] GeneratedBuilding finish() {
    FARLOD_EXPECTS(!building_.components.empty());
    const GeneratedComponent& first = building_.components.front();
    building_.footprint = first.footprint;
    building_.footprint_hole = first.footprint_hole;
    building_.base_mm = std::ranges::min(building_.components, {}, &GeneratedComponent::base_mm).base_mm;
    building_.top_mm = std::ranges::max(building_.components, {}, &GeneratedComponent::top_mm).top_mm;
    return std::move(building_);
  }

 private:
  [[nodiscard]] PointMm in_city(const Point3d& p) const {
    const Point2d p_city = rotation_.city_from_plan(horizontal(p));
    return {millimetres(p_city.x), millimetres(p_city.y), ground_mm_ + millimetres(p.z)};
  }

  [[nodiscard]] std::uint32_t vertex(const Point3d& p_plan) {
    const PointMm p = in_city(p_plan);
    // A linear search is fastest, since most solids have a few dozen corners
    const auto begin = building_.vertices.begin() + static_cast<std::ptrdiff_t>(first_vertex_);
    const auto known = std::find(begin, building_.vertices.end(), p);
    const auto number = static_cast<std::uint32_t>(known - building_.vertices.begin());
    if (known == building_.vertices.end()) building_.vertices.push_back(p);
    return number;
  }

  [[nodiscard]] std::vector<std::uint32_t> vertices(const PlanRing& ring) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(ring.size());
    for (const Point3d& p : ring) numbers.push_back(vertex(p));
    return numbers;
  }

  void add(const PlanFacet& facet, std::size_t first_facet) {
    GeneratedFacet result{.role = facet.role, .filling = facet.filling};
    result.outer = vertices(facet.outer);
    result.hole = vertices(facet.hole);
    for (const PlanRing& opening : facet.openings) result.openings.push_back(vertices(opening));
    if (facet.filling != Filling::none) result.in_wall = first_facet + facet.in_wall;
    building_.facets.push_back(std::move(result));
  }

  [[nodiscard]] std::vector<PlanPointMm> ring_in_city(const LotRing& ring) const {
    std::vector<PlanPointMm> result;
    for (const Point2d p : ring) {
      const PointMm p_city = in_city({p.x, p.y, 0.0});
      result.push_back({p_city.x, p_city.y});
    }
    return result;
  }

  const PlanRotation& rotation_;
  std::int64_t ground_mm_ = 0;
  std::size_t first_vertex_ = 0;
  GeneratedBuilding building_;
};

}  // namespace

GeneratedBuilding in_city(const PlanBuilding& building, const PlanRotation& rotation) {
  CityBuilder builder(rotation);
  for (const PlanSolid& solid : building.solids) builder.add(solid, building.id);
  GeneratedBuilding result = builder.finish();
  result.id = building.id;
  result.kind = building.kind;
  result.storeys = building.storeys;
  return result;
}

}  // namespace farlod
