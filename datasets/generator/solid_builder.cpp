// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/solid_builder.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace farlod {
namespace {

[[nodiscard]] std::vector<Point3d> at_height(const LotRing& ring, double z_m) {
  std::vector<Point3d> result;
  for (const Point2d p : ring) result.push_back({p.x, p.y, z_m});
  return result;
}

}  // namespace

PointMm SolidBuilder::city_from_lot(const Point3d& p_lot) const {
  const Point2d p_city = rotation_.city_from_plan(lot_.plan_from_lot(horizontal(p_lot)));
  return {millimetres(p_city.x), millimetres(p_city.y), base_mm_ + millimetres(p_lot.z)};
}

std::uint32_t SolidBuilder::vertex(const Point3d& p_lot) {
  const PointMm p = city_from_lot(p_lot);
  // A building has a few dozen corners at most: walking over them is the fastest search
  const auto known = std::ranges::find(building_.vertices, p);
  const auto number = static_cast<std::uint32_t>(known - building_.vertices.begin());
  if (known == building_.vertices.end()) building_.vertices.push_back(p);
  return number;
}

std::vector<std::uint32_t> SolidBuilder::vertices(std::span<const Point3d> ring_lot) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(ring_lot.size());
  for (const Point3d& p : ring_lot) numbers.push_back(vertex(p));
  return numbers;
}

void SolidBuilder::add_facet(FacetRole role, std::span<const Point3d> outer_lot, std::span<const Point3d> hole_lot) {
  FARLOD_EXPECTS(hole_lot.empty() || hole_lot.size() == outer_lot.size());
  std::vector<std::uint32_t> outer = vertices(outer_lot);
  building_.facets.push_back({role, std::move(outer), vertices(hole_lot)});
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
  const auto in_city = [this](const LotRing& lot_ring) {
    std::vector<PlanPointMm> result;
    for (const Point2d p : lot_ring) {
      const PointMm p_city = city_from_lot({p.x, p.y, 0.0});
      result.push_back({p_city.x, p_city.y});
    }
    return result;
  };
  building_.footprint = in_city(ring);
  building_.footprint_hole = in_city(reversed_ring(hole));
}

GeneratedBuilding SolidBuilder::finish() {
  FARLOD_EXPECTS(!building_.vertices.empty());
  const auto [lowest, highest] = std::ranges::minmax_element(building_.vertices, {}, &PointMm::z);
  building_.base_mm = lowest->z;
  building_.top_mm = highest->z;
  return std::exchange(building_, {});
}

}  // namespace farlod
