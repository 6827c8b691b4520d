// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/building_solid.hpp"

#include <algorithm>
#include <array>

#include "generator/solid_builder.hpp"

namespace farlod {
namespace {

/// How far the ends of a hip stand back, as a share of the longer side: a ridge always remains.
constexpr double longest_hip_share = 0.4;
/// How far the top of a stepped tower stands back, as a share of the tower's shorter side.
constexpr double step_share = 0.18;

[[nodiscard]] LotRing rectangle(Point2d low, Point2d high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }
[[nodiscard]] Point2d middle(Point2d a, Point2d b) { return 0.5 * (a + b); }
[[nodiscard]] Point3d raised(Point2d p, double z_m) { return {p.x, p.y, z_m}; }

[[nodiscard]] LotRing footprint(const BuildingPlan& plan) {
  const double w = plan.width_m, d = plan.depth_m, t = plan.wing_m;
  if (plan.shape == FootprintShape::l_shape) return {{0, 0}, {w, 0}, {w, t}, {t, t}, {t, d}, {0, d}};
  return rectangle({0, 0}, {w, d});
}

[[nodiscard]] LotRing court(const BuildingPlan& plan) {
  if (plan.shape != FootprintShape::courtyard) return {};
  return rectangle({plan.wing_m, plan.wing_m}, {plan.width_m - plan.wing_m, plan.depth_m - plan.wing_m});
}

void raise_prism(SolidBuilder& solid, const BuildingPlan& plan, double top_m) {
  const LotRing ring = footprint(plan), hole = court(plan);
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

void raise_stepped(SolidBuilder& solid, const BuildingPlan& plan) {
  const double step_m = on_plan_grid_m(step_share * std::min(plan.width_m, plan.depth_m));
  const double shoulder_m = plan.wall_m - plan.roof_rise_m;
  const LotRing ring = footprint(plan);
  const LotRing upper = rectangle({step_m, step_m}, {plan.width_m - step_m, plan.depth_m - step_m});
  solid.add_cap(FacetRole::ground, ring, 0.0);
  solid.add_walls(ring, 0.0, shoulder_m);
  solid.add_cap(FacetRole::roof, ring, shoulder_m, upper);
  solid.add_walls(upper, shoulder_m, plan.wall_m);
  solid.add_cap(FacetRole::roof, upper, plan.wall_m);
}

/// A wall with a gable: it ends in the ridge's end above its middle.
void add_gable(SolidBuilder& solid, Point2d a, Point2d b, Point3d ridge_end, double eaves_m) {
  const std::array corners{raised(a, 0.0), raised(b, 0.0), raised(b, eaves_m), ridge_end, raised(a, eaves_m)};
  solid.add_facet(FacetRole::wall, corners);
}

/// A slope of the roof: from the eaves a → b up to the ridge, which is walked from above b to above a.
void add_slope(SolidBuilder& solid, Point2d a, Point2d b, Point3d ridge_over_b, Point3d ridge_over_a, double eaves_m) {
  const std::array corners{raised(a, eaves_m), raised(b, eaves_m), ridge_over_b, ridge_over_a};
  solid.add_facet(FacetRole::roof, corners);
}

/// The rectangle's corners, turned so that the ridge runs along the first edge.
[[nodiscard]] LotRing corners_along_ridge(const BuildingPlan& plan) {
  const LotRing c = rectangle({0, 0}, {plan.width_m, plan.depth_m});
  const bool along_street = plan.kind == BuildingKind::attached || plan.width_m >= plan.depth_m;
  return along_street ? c : LotRing{c[1], c[2], c[3], c[0]};
}

void raise_gabled_rectangle(SolidBuilder& solid, const BuildingPlan& plan) {
  const LotRing c = corners_along_ridge(plan);
  const double eaves_m = plan.wall_m, ridge_m = plan.wall_m + plan.roof_rise_m;
  const Point3d begin = raised(middle(c[0], c[3]), ridge_m), end = raised(middle(c[1], c[2]), ridge_m);
  solid.add_cap(FacetRole::ground, c, 0.0);
  solid.add_wall(c[0], c[1], 0.0, eaves_m);
  add_gable(solid, c[1], c[2], end, eaves_m);
  solid.add_wall(c[2], c[3], 0.0, eaves_m);
  add_gable(solid, c[3], c[0], begin, eaves_m);
  add_slope(solid, c[0], c[1], end, begin, eaves_m);
  add_slope(solid, c[2], c[3], begin, end, eaves_m);
}

void raise_hipped_rectangle(SolidBuilder& solid, const BuildingPlan& plan) {
  const LotRing c = corners_along_ridge(plan);
  const double eaves_m = plan.wall_m, ridge_m = plan.wall_m + plan.roof_rise_m;
  const double long_m = norm(c[1] - c[0]), short_m = norm(c[2] - c[1]);
  const Point2d hip = (std::min(0.5 * short_m, longest_hip_share * long_m) / long_m) * (c[1] - c[0]);
  const Point3d begin = raised(middle(c[0], c[3]) + hip, ridge_m), end = raised(middle(c[1], c[2]) - hip, ridge_m);
  solid.add_cap(FacetRole::ground, c, 0.0);
  solid.add_walls(c, 0.0, eaves_m);
  add_slope(solid, c[0], c[1], end, begin, eaves_m);
  add_slope(solid, c[2], c[3], begin, end, eaves_m);
  const std::array begin_hip{raised(c[3], eaves_m), raised(c[0], eaves_m), begin};
  const std::array end_hip{raised(c[1], eaves_m), raised(c[2], eaves_m), end};
  solid.add_facet(FacetRole::roof, begin_hip);
  solid.add_facet(FacetRole::roof, end_hip);
}

/// Two ridges that meet above the corner of the L, with a hip outside and a valley inside, and a gable at each end.
void raise_gabled_l(SolidBuilder& solid, const BuildingPlan& plan) {
  const LotRing c = footprint(plan);
  const double eaves_m = plan.wall_m, ridge_m = plan.wall_m + plan.roof_rise_m;
  const Point3d along = raised(middle(c[1], c[2]), ridge_m);
  const Point3d corner = raised(middle(c[0], c[3]), ridge_m);
  const Point3d back = raised(middle(c[4], c[5]), ridge_m);
  solid.add_cap(FacetRole::ground, c, 0.0);
  for (const std::size_t k : {0U, 2U, 3U, 5U}) solid.add_wall(c[k], c[(k + 1) % 6], 0.0, eaves_m);
  add_gable(solid, c[1], c[2], along, eaves_m);
  add_gable(solid, c[4], c[5], back, eaves_m);
  add_slope(solid, c[0], c[1], along, corner, eaves_m);
  add_slope(solid, c[2], c[3], corner, along, eaves_m);
  add_slope(solid, c[3], c[4], back, corner, eaves_m);
  add_slope(solid, c[5], c[0], corner, back, eaves_m);
}

void raise_lod2(SolidBuilder& solid, const BuildingPlan& plan) {
  switch (plan.roof) {
    case RoofShape::flat:
      return raise_prism(solid, plan, plan.wall_m);
    case RoofShape::stepped:
      return raise_stepped(solid, plan);
    case RoofShape::hipped:
      return raise_hipped_rectangle(solid, plan);
    case RoofShape::gabled:
      break;
  }
  return plan.shape == FootprintShape::l_shape ? raise_gabled_l(solid, plan) : raise_gabled_rectangle(solid, plan);
}

/// Top of a block model: half-way up the roof, so that it holds about as much as the real one.
[[nodiscard]] double prism_top_m(const BuildingPlan& plan) {
  const bool pitched = plan.roof == RoofShape::gabled || plan.roof == RoofShape::hipped;
  return on_plan_grid_m(plan.wall_m + (pitched ? 0.5 * plan.roof_rise_m : 0.0));
}

}  // namespace

GeneratedBuilding raise(const BuildingPlan& plan, double ground_m, const PlanRotation& rotation, int lod) {
  SolidBuilder solid(plan.lot, rotation, ground_m);
  if (plan.arcade_depth_m > 0.0) {
    raise_arcade(solid, plan, plan.wall_m);
  } else if (lod == 1) {
    raise_prism(solid, plan, prism_top_m(plan));
  } else {
    raise_lod2(solid, plan);
  }
  solid.set_footprint(footprint(plan), court(plan));
  GeneratedBuilding building = solid.finish();
  building.kind = plan.kind;
  building.storeys = plan.storeys;
  return building;
}

}  // namespace farlod
