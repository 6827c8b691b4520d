// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/solid_builder.hpp"

#include <array>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
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

}  // namespace farlod
