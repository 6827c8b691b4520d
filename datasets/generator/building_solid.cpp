// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/building_solid.hpp"

#include <algorithm>

#include "generator/plane_polygons.hpp"

namespace farlod {
namespace {

/// The largest run of a hip, as a share of the longer side, so that a ridge remains.
constexpr double longest_hip_share = 0.4;

[[nodiscard]] Point2d middle(Point2d a, Point2d b) { return 0.5 * (a + b); }
[[nodiscard]] Point3d raised(Point2d p, double z_m) { return {p.x, p.y, z_m}; }
[[nodiscard]] Point2d direction(Point2d from, Point2d to) { return (1.0 / norm(to - from)) * (to - from); }

/// Adds a wall with a gable, whose top is the end of the ridge.
void add_gable(SolidBuilder& solid, Point2d a, Point2d b, Point3d ridge_end, double eaves_m) {
  const std::array corners{raised(a, 0.0), raised(b, 0.0), raised(b, eaves_m), ridge_end, raised(a, eaves_m)};
  solid.add_facet(FacetRole::wall, corners);
}

/// Adds a slope of the roof: from the lower border a → b up to the ridge.
void add_slope(SolidBuilder& solid, Point2d a, Point2d b, Point3d ridge_over_b, Point3d ridge_over_a, double border_m) {
  const std::array corners{raised(a, border_m), raised(b, border_m), ridge_over_b, ridge_over_a};
  solid.add_facet(FacetRole::roof, corners);
}

void raise_gabled_rectangle(SolidBuilder& solid, const BuildingPlan& plan, const Overhangs& overhangs) {
  const auto [c, o, along, across] = ridge_frame(plan, overhangs);
  const double eaves_m = plan.wall_m, ridge_m = plan.wall_m + plan.roof_rise_m;
  const double pitch = plan.roof_rise_m / (0.5 * norm(c[2] - c[1]));
  const Point2d before = -o[3] * along, behind = o[1] * along;
  const Point2d begin = middle(c[0], c[3]), end = middle(c[1], c[2]);
  solid.add_cap(FacetRole::ground, {c.begin(), c.end()}, 0.0);
  solid.add_wall(c[0], c[1], 0.0, eaves_m);
  add_gable(solid, c[1], c[2], raised(end, ridge_m), eaves_m);
  solid.add_wall(c[2], c[3], 0.0, eaves_m);
  add_gable(solid, c[3], c[0], raised(begin, ridge_m), eaves_m);
  const Point3d ridge_begin = raised(begin + before, ridge_m), ridge_end = raised(end + behind, ridge_m);
  const Point2d near = -o[0] * across, far = o[2] * across;
  add_slope(solid, c[0] + before + near, c[1] + behind + near, ridge_end, ridge_begin, eaves_m - pitch * o[0]);
  add_slope(solid, c[2] + behind + far, c[3] + before + far, ridge_begin, ridge_end, eaves_m - pitch * o[2]);
}

/// A slope of a hipped roof: its height above the eaves is value(p).
struct Slope {
  HalfPlane height;
  [[nodiscard]] double value(Point2d p) const { return height.value(p); }
};

/// The four slopes of a hipped roof, in the order of the edges that they rise from.
[[nodiscard]] std::array<Slope, 4> hip_slopes(const RidgeFrame& frame, double rise_m, double hip_m) {
  const auto& c = frame.c;
  const double side = rise_m / (0.5 * norm(c[2] - c[1])), end = rise_m / hip_m;
  const auto from_edge = [](Point2d corner, Point2d uphill) { return Slope{{uphill, -dot(uphill, corner)}}; };
  return {from_edge(c[0], side * frame.across), from_edge(c[1], -end * frame.along), from_edge(c[2], -side * frame.across),
          from_edge(c[3], end * frame.along)};
}

/// Adds a hipped roof with overhangs: the minimum of its four planes, also beyond the walls.
void add_overhanging_hips(SolidBuilder& solid, const RidgeFrame& frame, const std::array<Slope, 4>& slopes, double eaves_m) {
  const auto& [c, o, along, across] = frame;
  const PlanePolygon outline{c[0] - o[3] * along - o[0] * across, c[1] + o[1] * along - o[0] * across,
                             c[2] + o[1] * along + o[2] * across, c[3] - o[3] * along + o[2] * across};
  for (const Slope& slope : slopes) {
    PlanePolygon polygon = outline;
    for (const Slope& other : slopes)
      if (&other != &slope)
        polygon = clipped(polygon, {slope.height.slope - other.height.slope, slope.height.offset - other.height.offset});
    std::vector<Point3d> corners;
    for (const Point2d p : polygon) corners.push_back(raised(p, eaves_m + slope.value(p)));
    solid.add_facet(FacetRole::roof, corners);
  }
}

void raise_hipped_rectangle(SolidBuilder& solid, const BuildingPlan& plan, const Overhangs& overhangs) {
  const RidgeFrame frame = ridge_frame(plan, overhangs);
  const auto& c = frame.c;
  const double eaves_m = plan.wall_m, ridge_m = plan.wall_m + plan.roof_rise_m;
  const double long_m = norm(c[1] - c[0]), short_m = norm(c[2] - c[1]);
  const double hip_m = std::min(0.5 * short_m, longest_hip_share * long_m);
  solid.add_cap(FacetRole::ground, {c.begin(), c.end()}, 0.0);
  solid.add_walls({c.begin(), c.end()}, 0.0, eaves_m);
  if (std::ranges::any_of(frame.overhang_m, [](double m) { return m > 0.0; }))
    return add_overhanging_hips(solid, frame, hip_slopes(frame, plan.roof_rise_m, hip_m), eaves_m);
  const Point2d hip = (hip_m / long_m) * (c[1] - c[0]);
  const Point3d begin = raised(middle(c[0], c[3]) + hip, ridge_m), end = raised(middle(c[1], c[2]) - hip, ridge_m);
  add_slope(solid, c[0], c[1], end, begin, eaves_m);
  add_slope(solid, c[2], c[3], begin, end, eaves_m);
  const std::array begin_hip{raised(c[3], eaves_m), raised(c[0], eaves_m), begin};
  const std::array end_hip{raised(c[1], eaves_m), raised(c[2], eaves_m), end};
  solid.add_facet(FacetRole::roof, begin_hip);
  solid.add_facet(FacetRole::roof, end_hip);
}

/// Two ridges that meet above the corner of the L, with a hip outside and a valley inside, and a gable at each end.
void raise_gabled_l(SolidBuilder& solid, const BuildingPlan& plan, const Overhangs& overhangs) {
  const LotRing c = footprint_ring(plan);
  const double eaves_m = plan.wall_m, ridge_m = plan.wall_m + plan.roof_rise_m;
  const double over_m = std::min({overhangs[0], overhangs[2], overhangs[3], overhangs[5]});
  const double border_m = eaves_m - plan.roof_rise_m / (0.5 * plan.wing_m) * over_m;
  const Point2d end{overhangs[1], 0.0}, top{0.0, overhangs[4]}, out{over_m, 0.0}, up{0.0, over_m};
  const Point2d along = middle(c[1], c[2]), corner = middle(c[0], c[3]), back = middle(c[4], c[5]);
  solid.add_cap(FacetRole::ground, c, 0.0);
  for (const std::size_t k : {0U, 2U, 3U, 5U}) solid.add_wall(c[k], c[(k + 1) % 6], 0.0, eaves_m);
  add_gable(solid, c[1], c[2], raised(along, ridge_m), eaves_m);
  add_gable(solid, c[4], c[5], raised(back, ridge_m), eaves_m);
  const Point3d ridge_end = raised(along + end, ridge_m), bend = raised(corner, ridge_m), ridge_top = raised(back + top, ridge_m);
  add_slope(solid, c[0] - out - up, c[1] + end - up, ridge_end, bend, border_m);
  add_slope(solid, c[2] + end + up, c[3] + out + up, bend, ridge_end, border_m);
  add_slope(solid, c[3] + out + up, c[4] + out + top, ridge_top, bend, border_m);
  add_slope(solid, c[5] - out + top, c[0] - out - up, bend, ridge_top, border_m);
}

}  // namespace

RidgeFrame ridge_frame(const BuildingPlan& plan, const Overhangs& overhangs) {
  const LotRing ring = footprint_ring(plan);
  const bool along_street = plan.kind == BuildingKind::attached || plan.width_m >= plan.depth_m;
  const std::size_t first = along_street ? 0 : 1;
  RidgeFrame frame;
  for (std::size_t k = 0; k < 4; ++k) {
    frame.c[k] = ring[(first + k) % 4];
    frame.overhang_m[k] = overhangs[(first + k) % 4];
  }
  frame.along = direction(frame.c[0], frame.c[1]);
  frame.across = direction(frame.c[0], frame.c[3]);
  return frame;
}

namespace {

/// Builds the solid of a plan with a gabled or hipped roof. Where the roof has an overhang, its planes continue beyond the walls
/// and below the eaves, as sheets without thickness that touch no wall; the solid is not closed then. The roof of an L projects
/// over all its eaves by the smallest of their overhangs.
void raise_pitched(SolidBuilder& solid, const BuildingPlan& plan, const Overhangs& overhangs) {
  if (plan.shape == FootprintShape::l_shape) {
    raise_gabled_l(solid, plan, overhangs);
  } else if (plan.roof == RoofShape::hipped) {
    raise_hipped_rectangle(solid, plan, overhangs);
  } else {
    raise_gabled_rectangle(solid, plan, overhangs);
  }
  if (std::ranges::any_of(overhangs, [](double m) { return m > 0.0; })) solid.leave_open();
}

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
