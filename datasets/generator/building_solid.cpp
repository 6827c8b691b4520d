// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/building_solid.hpp"

#include <algorithm>
#include <array>

#include "generator/pitched_roof.hpp"
#include "generator/solid_builder.hpp"

namespace farlod {
namespace {

/// How far the top of a stepped tower stands back, as a share of the tower's shorter side.
constexpr double step_share = 0.18;

[[nodiscard]] LotRing rectangle(Point2d low, Point2d high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

[[nodiscard]] LotRing court(const BuildingPlan& plan) {
  if (plan.shape != FootprintShape::courtyard) return {};
  return rectangle({plan.wing_m, plan.wing_m}, {plan.width_m - plan.wing_m, plan.depth_m - plan.wing_m});
}

void raise_prism(SolidBuilder& solid, const BuildingPlan& plan, double top_m) {
  const LotRing ring = footprint_ring(plan), hole = court(plan);
  const FacetRole underside = plan.clearance_m > 0.0 ? FacetRole::outer_ceiling : FacetRole::ground;
  solid.add_cap(underside, ring, plan.clearance_m, hole);
  solid.add_walls(ring, plan.clearance_m, top_m);
  solid.add_walls(reversed_ring(hole), plan.clearance_m, top_m);
  solid.add_cap(FacetRole::roof, ring, top_m, hole);
}

/// The upper floors reach over an open ground floor on the street's side (v = 0).
void raise_arcade(SolidBuilder& solid, const BuildingPlan& plan, double top_m) {
  const double w = plan.width_m, d = plan.depth_m, back = plan.arcade_depth_m, open = plan.arcade_height_m;
  const LotRing lower = rectangle({0, back}, {w, d});
  solid.add_cap(FacetRole::ground, lower, 0.0);
  solid.add_wall(lower[0], lower[1], 0.0, open);
  solid.add_cap(FacetRole::outer_ceiling, rectangle({0, 0}, {w, back}), open);
  solid.add_wall({0, 0}, {w, 0}, open, top_m);
  solid.add_wall({w, d}, {0, d}, 0.0, top_m);
  // The side walls follow the profile of the arcade
  const std::array right{Point3d{w, back, 0},  Point3d{w, d, 0},    Point3d{w, d, top_m},
                         Point3d{w, 0, top_m}, Point3d{w, 0, open}, Point3d{w, back, open}};
  const std::array left{Point3d{0, d, 0},    Point3d{0, back, 0},  Point3d{0, back, open},
                        Point3d{0, 0, open}, Point3d{0, 0, top_m}, Point3d{0, d, top_m}};
  solid.add_facet(FacetRole::wall, right);
  solid.add_facet(FacetRole::wall, left);
  solid.add_cap(FacetRole::roof, rectangle({0, 0}, {w, d}), top_m);
}

/// The upper floors project over the ground floor all around.
void raise_projecting(SolidBuilder& solid, const BuildingPlan& plan, double top_m) {
  const double back = plan.projection_m, open = plan.arcade_height_m;
  const LotRing upper = footprint_ring(plan);
  const LotRing lower = rectangle({back, back}, {plan.width_m - back, plan.depth_m - back});
  solid.add_cap(FacetRole::ground, lower, 0.0);
  solid.add_walls(lower, 0.0, open);
  solid.add_cap(FacetRole::outer_ceiling, upper, open, lower);
  solid.add_walls(upper, open, top_m);
  solid.add_cap(FacetRole::roof, upper, top_m);
}

void raise_stepped(SolidBuilder& solid, const BuildingPlan& plan) {
  const double step_m = on_plan_grid_m(step_share * std::min(plan.width_m, plan.depth_m));
  const double shoulder_m = plan.wall_m - plan.roof_rise_m;
  const LotRing ring = footprint_ring(plan);
  const LotRing upper = rectangle({step_m, step_m}, {plan.width_m - step_m, plan.depth_m - step_m});
  solid.add_cap(FacetRole::ground, ring, 0.0);
  solid.add_walls(ring, 0.0, shoulder_m);
  solid.add_cap(FacetRole::roof, ring, shoulder_m, upper);
  solid.add_walls(upper, shoulder_m, plan.wall_m);
  solid.add_cap(FacetRole::roof, upper, plan.wall_m);
}

void raise_lod2(SolidBuilder& solid, const BuildingPlan& plan, const Overhangs& overhangs) {
  switch (plan.roof) {
    case RoofShape::flat:
      return raise_prism(solid, plan, plan.wall_m);
    case RoofShape::stepped:
      return raise_stepped(solid, plan);
    case RoofShape::hipped:
    case RoofShape::gabled:
      break;
  }
  raise_pitched(solid, plan, overhangs);
}

/// Top of a block model: half-way up the roof, so that it holds about as much as the real one.
[[nodiscard]] double prism_top_m(const BuildingPlan& plan) {
  return on_plan_grid_m(plan.wall_m + (has_pitched_roof(plan) ? 0.5 * plan.roof_rise_m : 0.0));
}

}  // namespace

PlanSolid raise(const BuildingPlan& plan, double ground_m, int lod, const Overhangs& overhangs) {
  SolidBuilder solid(plan.lot, ground_m);
  if (plan.arcade_depth_m > 0.0) {
    raise_arcade(solid, plan, plan.wall_m);
  } else if (plan.projection_m > 0.0) {
    raise_projecting(solid, plan, plan.wall_m);
  } else if (lod == 1) {
    raise_prism(solid, plan, prism_top_m(plan));
  } else {
    raise_lod2(solid, plan, overhangs);
  }
  solid.set_footprint(footprint_ring(plan), court(plan));
  return solid.finish();
}

}  // namespace farlod
