// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/building_details.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "generator/building_solid.hpp"
#include "generator/plane_polygons.hpp"

namespace farlod {
namespace {

constexpr double bay_m = 3.2, window_width_m = 1.2, sill_m = 0.9, head_m = 2.3;
constexpr double door_width_m = 1.0, door_sill_m = 0.15, door_head_m = 2.25;
constexpr double set_back_m = 0.12, set_back_share = 0.5;
/// The least height of a row of windows. Lower storeys share one row.
constexpr double least_row_m = 2.6;
/// The least distance between an opening and the border of its wall.
constexpr double least_margin_m = 0.12;

/// The vertical rectangle above the lower edge of a wall, without its gable.
struct WallRectangle {
  Point2d a, b;
  double low_m, high_m;

  [[nodiscard]] double width_m() const { return norm(b - a); }
  [[nodiscard]] Point2d along() const { return (1.0 / width_m()) * (b - a); }
  /// Unit vector into the building: it lies to the left of a → b.
  [[nodiscard]] Point2d inwards() const { return {-along().y, along().x}; }
};

[[nodiscard]] bool has_rectangle(const PlanFacet& facet) {
  const PlanRing& r = facet.outer;
  return facet.role == FacetRole::wall && facet.filling == Filling::none && (r.size() == 4 || r.size() == 5) &&
         r[0].z == r[1].z && horizontal(r[1]) == horizontal(r[2]) && horizontal(r[0]) == horizontal(r.back());
}

struct Opening {
  Filling filling;
  double middle_m, width_m, low_m, high_m;  ///< distance along the wall from its left end; heights above the ground
};

/// The corners of an opening, counter-clockwise seen from outside, in the plane `behind_m` behind the wall.
[[nodiscard]] PlanRing ring_of(const WallRectangle& wall, const Opening& o, double behind_m) {
  const Point2d inwards = behind_m * wall.inwards();
  const Point2d left = wall.a + (o.middle_m - 0.5 * o.width_m) * wall.along() + inwards;
  const Point2d right = wall.a + (o.middle_m + 0.5 * o.width_m) * wall.along() + inwards;
  return {{left.x, left.y, o.low_m}, {right.x, right.y, o.low_m}, {right.x, right.y, o.high_m}, {left.x, left.y, o.high_m}};
}

class OpeningCutter {
 public:
  OpeningCutter(PlanSolid& solid, double row_m, double behind_m) : solid_(solid), row_m_(row_m), behind_m_(behind_m) {}

  void cut(std::size_t wall_row) {
    const PlanRing& r = solid_.facets[wall_row].outer;
    const WallRectangle wall{horizontal(r[0]), horizontal(r[1]), r[0].z, r[2].z};
    const int bays = static_cast<int>(wall.width_m() / bay_m);
    const bool has_door = !door_is_there_ && wall.low_m == 0.0 && bays > 0;
    for (int row = 0; row * row_m_ < wall.high_m; ++row)
      for (int bay = 0; bay < bays; ++bay)
        add(wall_row, wall, opening(has_door && row == 0 && bay == bays / 2, row, (bay + 0.5) * wall.width_m() / bays));
    door_is_there_ |= has_door;
  }

 private:
  [[nodiscard]] Opening opening(bool is_door, int row, double middle_m) const {
    const double floor_m = row * row_m_;
    if (is_door) return {Filling::door, middle_m, door_width_m, door_sill_m, door_head_m};
    return {Filling::window, middle_m, window_width_m, on_plan_grid_m(floor_m + sill_m), on_plan_grid_m(floor_m + head_m)};
  }

  void add(std::size_t wall_row, const WallRectangle& wall, const Opening& o) {
    if (o.low_m < wall.low_m + least_margin_m || o.high_m > wall.high_m - least_margin_m) return;
    const PlanRing in_wall = ring_of(wall, o, 0.0), filling = ring_of(wall, o, behind_m_);
    solid_.facets[wall_row].openings.push_back(reversed_ring(in_wall));
    solid_.facets.push_back({.outer = filling, .filling = o.filling, .in_wall = wall_row});
    if (behind_m_ == 0.0) return;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      solid_.facets.push_back({.outer = {in_wall[k], in_wall[next], filling[next], filling[k]}});
    }
  }

  PlanSolid& solid_;
  double row_m_, behind_m_;
  bool door_is_there_ = false;
};

}  // namespace

void add_openings(KeyedRandom& random, const BuildingPlan& plan, const TouchingWalls& walls, std::size_t row, PlanSolid& solid) {
  const bool set_back = random.chance(set_back_share);
  OpeningCutter cutter(solid, std::max(least_row_m, plan.wall_m / plan.storeys), set_back ? set_back_m : 0.0);
  const std::size_t facets = solid.facets.size();
  for (std::size_t k = 0; k < facets; ++k) {
    const PlanRing& r = solid.facets[k].outer;
    if (has_rectangle(solid.facets[k]) && !walls.touches(row, horizontal(r[0]), horizontal(r[1]))) cutter.cut(k);
  }
}

namespace {

/// The vertical plane of a wall, and the side that the wall faces. `s` is the coordinate along the wall, to the right as seen
/// from outside.
struct WallPlane {
  enum class Side { east, north, west, south } looks_to = Side::south;
  std::int64_t at_mm = 0;
  bool operator==(const WallPlane&) const = default;

  [[nodiscard]] WallPlane from_behind() const {
    constexpr std::array opposite{Side::west, Side::south, Side::east, Side::north};
    return {opposite.at(static_cast<std::size_t>(looks_to)), at_mm};
  }
  [[nodiscard]] bool runs_along_y() const { return looks_to == Side::east || looks_to == Side::west; }
  [[nodiscard]] bool runs_up() const { return looks_to == Side::east || looks_to == Side::south; }
  [[nodiscard]] double s(const Point3d& p) const { return (runs_up() ? 1.0 : -1.0) * (runs_along_y() ? p.y : p.x); }
  [[nodiscard]] Point3d point(Point2d sz) const {
    const double along_m = runs_up() ? sz.x : -sz.x, at_m = static_cast<double>(at_mm) * 1e-3;
    return runs_along_y() ? Point3d{at_m, along_m, sz.y} : Point3d{along_m, at_m, sz.y};
  }
};

/// The plane of a wall. All walls of a block are parallel to an axis of the plan.
[[nodiscard]] WallPlane plane_of(const PlanRing& ring) {
  Point3d normal;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) normal = normal + cross(ring[k] - ring[0], ring[k + 1] - ring[0]);
  using Side = WallPlane::Side;
  if (std::abs(normal.x) > std::abs(normal.y)) return {normal.x > 0.0 ? Side::east : Side::west, millimetres(ring[0].x)};
  return {normal.y > 0.0 ? Side::north : Side::south, millimetres(ring[0].y)};
}

/// The wall in its plane: s and the height above z = 0. Convex pieces, counter-clockwise.
[[nodiscard]] std::vector<PlanePolygon> pieces_of(const PlanRing& ring, const WallPlane& plane, double ground_m) {
  PlanePolygon polygon;
  for (const Point3d& p : ring) polygon.push_back({plane.s(p), p.z + ground_m});
  if (is_convex(polygon)) return {polygon};
  std::vector<GridPoint> corners;
  std::vector<std::uint32_t> numbers;
  for (const Point2d p : polygon) {
    numbers.push_back(static_cast<std::uint32_t>(corners.size()));
    corners.push_back({millimetres(p.x), millimetres(p.y)});
  }
  std::vector<PlanePolygon> pieces;
  for (const GridTriangle& t : triangles(corners, {numbers})) pieces.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
  return pieces;
}

/// A convex piece of a wall, in the plane of the walls that it covers, which face it.
struct Cover {
  std::size_t building;
  WallPlane plane;  ///< of the walls that it covers
  PlanePolygon polygon;
};

[[nodiscard]] std::vector<Cover> covers_of(const std::vector<PlanBuilding>& buildings) {
  std::vector<Cover> covers;
  for (std::size_t k = 0; k < buildings.size(); ++k)
    for (const PlanSolid& solid : buildings[k].solids)
      for (const PlanFacet& facet : solid.facets) {
        if (solid.kind == ComponentKind::installation || facet.role != FacetRole::wall) continue;
        const WallPlane behind = plane_of(facet.outer).from_behind();
        const PlanRing seen_from_behind(facet.outer.rbegin(), facet.outer.rend());
        for (PlanePolygon& piece : pieces_of(seen_from_behind, behind, solid.ground_m))
          covers.push_back({k, behind, std::move(piece)});
      }
  return covers;
}

class ShellOpener {
 public:
  ShellOpener(const std::vector<Cover>& covers, std::size_t building) : covers_(covers), building_(building) {}

  void open(PlanSolid& solid) const {
    std::vector<PlanFacet> kept;
    std::vector<std::size_t> new_row(solid.facets.size());
    for (std::size_t k = 0; k < solid.facets.size(); ++k) {
      PlanFacet& facet = solid.facets[k];
      new_row[k] = kept.size();
      if (facet.role == FacetRole::ground) continue;
      if (facet.filling != Filling::none) facet.in_wall = new_row[facet.in_wall];
      if (facet.role == FacetRole::wall && facet.openings.empty() && facet.filling == Filling::none)
        add_rest(facet, solid.ground_m, kept);
      else
        kept.push_back(std::move(facet));
    }
    solid.facets = std::move(kept);
    solid.closed = false;
  }

 private:
  void add_rest(PlanFacet& wall, double ground_m, std::vector<PlanFacet>& kept) const {
    const WallPlane plane = plane_of(wall.outer);
    const std::vector<PlanePolygon> whole = pieces_of(wall.outer, plane, ground_m);
    std::vector<PlanePolygon> rest = whole;
    for (const Cover& cover : covers_)
      if (cover.building != building_ && cover.plane == plane) rest = without_all(rest, cover.polygon);
    if (rest == whole) return kept.push_back(std::move(wall));
    for (const PlanePolygon& piece : rest) {
      PlanFacet& facet = kept.emplace_back();
      for (const Point2d sz : piece) facet.outer.push_back(plane.point({sz.x, sz.y - ground_m}));
    }
  }

  [[nodiscard]] static std::vector<PlanePolygon> without_all(const std::vector<PlanePolygon>& pieces, const PlanePolygon& clip) {
    std::vector<PlanePolygon> result;
    for (const PlanePolygon& piece : pieces)
      for (PlanePolygon& left : without(piece, clip)) result.push_back(std::move(left));
    return result;
  }

  const std::vector<Cover>& covers_;
  std::size_t building_;
};

}  // namespace

void open_shells(std::vector<PlanBuilding>& buildings) {
  const std::vector<Cover> covers = covers_of(buildings);
  for (std::size_t k = 0; k < buildings.size(); ++k)
    for (PlanSolid& solid : buildings[k].solids)
      if (solid.kind != ComponentKind::installation) ShellOpener(covers, k).open(solid);
}

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
