// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/roof_installations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "generator/pitched_roof.hpp"

namespace farlod {
namespace {

constexpr double chimney_share = 0.7, dormer_share = 0.5;
constexpr double chimney_edge_m = 0.6, chimney_from_ridge_m = 0.6, chimney_below_ridge_m = 1.4, chimney_above_ridge_m = 0.8;
constexpr double dormer_width_m = 1.6, dormer_bay_m = 3.5, dormer_behind_wall_m = 0.8, dormer_front_m = 1.0, dormer_rise_m = 0.5;
/// The least rise of a roof with dormers, which must end below its ridge.
constexpr double least_rise_for_dormers_m = 3.0;

[[nodiscard]] bool is_gabled_house(const BuildingPlan& plan) {
  const bool house = plan.kind == BuildingKind::detached || plan.kind == BuildingKind::attached;
  return house && plan.roof == RoofShape::gabled && plan.shape == FootprintShape::rectangle;
}

void add_installation(PlanBuilding& building, SolidBuilder& solid, std::string suffix) {
  PlanSolid& added = building.solids.emplace_back(solid.finish());
  added.kind = ComponentKind::installation;
  added.suffix = std::move(suffix);
}

/// The rectangle from `u` along and `v` across the ridge frame, counter-clockwise.
[[nodiscard]] LotRing rectangle_in(const RidgeFrame& f, double begin_u, double end_u, double begin_v, double end_v) {
  const auto at = [&f](double u, double v) { return f.c[0] + u * f.along + v * f.across; };
  return {at(begin_u, begin_v), at(end_u, begin_v), at(end_u, end_v), at(begin_u, end_v)};
}

void add_chimney(const BuildingPlan& plan, const RidgeFrame& frame, double at_u_m, PlanBuilding& building) {
  const double ridge_m = plan.wall_m + plan.roof_rise_m, v_m = 0.5 * norm(frame.c[3] - frame.c[0]) + chimney_from_ridge_m;
  const double half_m = 0.5 * chimney_edge_m;
  const LotRing ring = rectangle_in(frame, at_u_m - half_m, at_u_m + half_m, v_m - half_m, v_m + half_m);
  SolidBuilder solid(plan.lot, building.solids.front().ground_m);
  solid.add_cap(FacetRole::outer_ceiling, ring, ridge_m - chimney_below_ridge_m);
  solid.add_walls(ring, ridge_m - chimney_below_ridge_m, ridge_m + chimney_above_ridge_m);
  solid.add_cap(FacetRole::roof, ring, ridge_m + chimney_above_ridge_m);
  add_installation(building, solid, "_chimney");
}

/// Adds a dormer: a small gabled house on the level of the eaves, whose ridge ends in the slope over the first edge of the frame.
void add_dormer(const BuildingPlan& plan, const RidgeFrame& frame, double middle_u_m, int number, PlanBuilding& building) {
  const double half_span_m = 0.5 * norm(frame.c[3] - frame.c[0]), pitch = plan.roof_rise_m / half_span_m;
  const double low_m = plan.wall_m, eaves_m = low_m + pitch * dormer_behind_wall_m + dormer_front_m;
  const double ridge_m = eaves_m + dormer_rise_m;
  const LotRing c = rectangle_in(frame, middle_u_m - 0.5 * dormer_width_m, middle_u_m + 0.5 * dormer_width_m,
                                 dormer_behind_wall_m, std::min(half_span_m, (ridge_m - low_m) / pitch + 0.1));
  const auto at = [](Point2d p, double z_m) { return Point3d{p.x, p.y, z_m}; };
  const Point3d front = at(0.5 * (c[0] + c[1]), ridge_m), back = at(0.5 * (c[3] + c[2]), ridge_m);
  SolidBuilder solid(plan.lot, building.solids.front().ground_m);
  solid.add_cap(FacetRole::outer_ceiling, c, low_m);
  solid.add_wall(c[1], c[2], low_m, eaves_m);
  solid.add_wall(c[3], c[0], low_m, eaves_m);
  solid.add_facet(FacetRole::wall, std::array{at(c[0], low_m), at(c[1], low_m), at(c[1], eaves_m), front, at(c[0], eaves_m)});
  solid.add_facet(FacetRole::wall, std::array{at(c[2], low_m), at(c[3], low_m), at(c[3], eaves_m), back, at(c[2], eaves_m)});
  solid.add_facet(FacetRole::roof, std::array{at(c[1], eaves_m), at(c[2], eaves_m), back, front});
  solid.add_facet(FacetRole::roof, std::array{at(c[3], eaves_m), at(c[0], eaves_m), front, back});
  add_installation(building, solid, fmt::format("_dormer_{}", number));
}

}  // namespace

void maybe_add_roof_installations(KeyedRandom& random, const BuildingPlan& plan, PlanBuilding& building) {
  const bool has_chimney = random.chance(chimney_share), has_dormers = random.chance(dormer_share);
  const double chimney_at = random.between(0.2, 0.8);
  if (!is_gabled_house(plan)) return;
  const RidgeFrame frame = ridge_frame(plan, {});
  const double length_m = norm(frame.c[1] - frame.c[0]);
  if (has_chimney) add_chimney(plan, frame, chimney_at * length_m, building);
  const int dormers = has_dormers && plan.roof_rise_m >= least_rise_for_dormers_m ? static_cast<int>(length_m / dormer_bay_m) : 0;
  for (int k = 0; k < dormers; ++k) add_dormer(plan, frame, (k + 0.5) * length_m / dormers, k, building);
}

}  // namespace farlod
