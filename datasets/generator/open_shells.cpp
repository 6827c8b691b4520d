// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/open_shells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "generator/plane_polygons.hpp"

namespace farlod {
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
  [[nodiscard]] double s(const Point3d& p) const {
    const bool runs_along_y = looks_to == Side::east || looks_to == Side::west;
    const bool runs_up = looks_to == Side::east || looks_to == Side::south;
    return (runs_up ? 1.0 : -1.0) * (runs_along_y ? p.y : p.x);
  }
  [[nodiscard]] Point3d point(Point2d sz) const {
    const bool runs_up = looks_to == Side::east || looks_to == Side::south;
    const double along_m = runs_up ? sz.x : -sz.x, at_m = static_cast<double>(at_mm) * 1e-3;
    const bool runs_along_y = looks_to == Side::east || looks_to == Side::west;
    return runs_along_y ? Point3d{at_m, along_m, sz.y} : Point3d{along_m, at_m, sz.y};
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

}  // namespace farlod
