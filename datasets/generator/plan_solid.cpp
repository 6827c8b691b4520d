// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plan_solid.hpp"

#include <algorithm>
#include <cmath>
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

namespace {

[[nodiscard]] std::vector<Point3d> at_height(const LotRing& ring, double z_m) {
  std::vector<Point3d> result;
  for (const Point2d p : ring) result.push_back({p.x, p.y, z_m});
  return result;
}

}  // namespace

PlanRing SolidBuilder::in_plan(std::span<const Point3d> ring_lot) const {
  PlanRing result;
  result.reserve(ring_lot.size());
  for (const Point3d& p : ring_lot) {
    const Point2d p_plan = lot_.plan_from_lot(horizontal(p));
    result.push_back({p_plan.x, p_plan.y, p.z});
  }
  return result;
}

void SolidBuilder::add_facet(FacetRole role, std::span<const Point3d> outer_lot, std::span<const Point3d> hole_lot) {
  FARLOD_EXPECTS(hole_lot.empty() || hole_lot.size() == outer_lot.size());
  PlanFacet facet{.role = role, .outer = in_plan(outer_lot), .hole = in_plan(hole_lot)};
  solid_.facets.push_back(std::move(facet));
}

void SolidBuilder::add_cap(FacetRole role, const LotRing& ring, double z_m, const LotRing& hole) {
  const bool looks_up = role == FacetRole::roof;
  add_facet(role, at_height(looks_up ? ring : reversed_ring(ring), z_m), at_height(looks_up ? reversed_ring(hole) : hole, z_m));
}

void SolidBuilder::add_wall(Point2d a, Point2d b, double low_m, double high_m) {
  const std::array corners{Point3d{a.x, a.y, low_m}, Point3d{b.x, b.y, low_m}, Point3d{b.x, b.y, high_m},
                           Point3d{a.x, a.y, high_m}};
  add_facet(FacetRole::wall, corners);
}

void SolidBuilder::add_walls(const LotRing& ring, double low_m, double high_m) {
  for (std::size_t k = 0; k < ring.size(); ++k) add_wall(ring[k], ring[(k + 1) % ring.size()], low_m, high_m);
}

void SolidBuilder::set_footprint(const LotRing& ring, const LotRing& hole) {
  for (const Point2d p : ring) solid_.footprint.push_back(lot_.plan_from_lot(p));
  for (const Point2d p : reversed_ring(hole)) solid_.footprint_hole.push_back(lot_.plan_from_lot(p));
}

PlanSolid SolidBuilder::finish() {
  FARLOD_EXPECTS(!solid_.facets.empty());
  return std::move(solid_);
}

TouchingWalls::TouchingWalls(std::span<const BuildingPlan> plans) {
  for (std::size_t n = 0; n < plans.size(); ++n) {
    const std::vector<Point2d> ring = footprint_ring(plans[n]);
    const LotFrame& lot = plans[n].lot;
    for (std::size_t k = 0; k < ring.size(); ++k)
      lines_.push_back(line_of(n, lot.plan_from_lot(ring[k]), lot.plan_from_lot(ring[(k + 1) % ring.size()])));
  }
}

TouchingWalls::Line TouchingWalls::line_of(std::size_t building, Point2d a, Point2d b) {
  const auto cm = [](double x_m) { return static_cast<std::int64_t>(std::llround(100.0 * x_m)); };
  const std::array from{cm(a.x), cm(a.y)}, to{cm(b.x), cm(b.y)};
  return {building, std::min(from, to), std::max(from, to)};
}

bool TouchingWalls::touches(const Line& line) const {
  return std::ranges::any_of(lines_, [&line](const Line& other) {
    if (other.building == line.building) return false;
    // Two segments overlap if their intervals on one axis overlap and their positions on the other are equal
    for (const std::size_t across : {0U, 1U}) {
      const std::size_t along = 1 - across;
      const bool in_line = line.low_cm[across] == line.high_cm[across] && other.low_cm[across] == other.high_cm[across] &&
                           line.low_cm[across] == other.low_cm[across];
      if (in_line && line.low_cm[along] < other.high_cm[along] && other.low_cm[along] < line.high_cm[along]) return true;
    }
    return false;
  });
}

bool TouchingWalls::touches(std::size_t building, Point2d a, Point2d b) const { return touches(line_of(building, a, b)); }

bool TouchingWalls::touches_any(std::size_t building) const {
  return std::ranges::any_of(lines_, [&](const Line& line) { return line.building == building && touches(line); });
}

}  // namespace farlod
