// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

/// A ring of points in the frame of a lot or of the plan.
using LotRing = std::vector<Point2d>;
using PlanRing = std::vector<Point3d>;

/// A facet in the plan frame; z is relative to `PlanSolid::ground_m`. Rings are oriented as in GeneratedFacet.
struct PlanFacet {
  FacetRole role = FacetRole::wall;
  PlanRing outer = {}, hole = {};
  std::vector<PlanRing> openings = {};  ///< clockwise, each filled by a window or a door
  Filling filling = Filling::none;
  std::size_t in_wall = 0;  ///< of a window or a door: the facet of the same solid whose opening it fills
};

/// A solid in the plan frame, in which walls are parallel to the axes and neighbors touch exactly. Its corners are not rounded to
/// millimetres yet.
struct PlanSolid {
  ComponentKind kind = ComponentKind::body;
  std::string suffix;  ///< of its id, after the id of the building; empty for the body
  double ground_m = 0.0;
  bool closed = true;
  std::vector<PlanFacet> facets;
  LotRing footprint, footprint_hole;  ///< plan frame
};

/// A building in the plan frame.
struct PlanBuilding {
  std::string id;
  BuildingKind kind = BuildingKind::detached;
  int storeys = 1;
  std::vector<PlanSolid> solids = {};
};

/// Turns a building into the city frame and rounds its corners to millimetres.
[[nodiscard]] GeneratedBuilding in_city(const PlanBuilding& building, const PlanRotation& rotation);

/// Builds a solid in the plan frame from facets in the frame of a lot.
class SolidBuilder {
 public:
  SolidBuilder(const LotFrame& lot, double ground_m) : lot_(lot) { solid_.ground_m = ground_m; }

  /// Corners are counter-clockwise seen from outside; z is relative to the ground.
  void add_facet(FacetRole role, std::span<const Point3d> outer_lot, std::span<const Point3d> hole_lot = {});
  /// A horizontal facet at height z over a counter-clockwise ring and around a counter-clockwise hole.
  void add_cap(FacetRole role, const LotRing& ring, double z_m, const LotRing& hole = {});
  /// A vertical rectangle over the edge from a to b that faces to the right of that direction.
  void add_wall(Point2d a, Point2d b, double low_m, double high_m);
  /// Walls over all edges of a counter-clockwise ring.
  void add_walls(const LotRing& ring, double low_m, double high_m);
  void set_footprint(const LotRing& ring, const LotRing& hole);

  /// Notes that the facets do not enclose a volume.
  void leave_open() { solid_.closed = false; }

  /// The solid; the builder is empty afterwards.
  [[nodiscard]] PlanSolid finish();

 private:
  [[nodiscard]] PlanRing in_plan(std::span<const Point3d> ring_lot) const;

  LotFrame lot_;
  PlanSolid solid_;
};

/// The reversed ring, with the same first corner.
template <class Point>
[[nodiscard]] std::vector<Point> reversed_ring(const std::vector<Point>& ring) {
  if (ring.empty()) return {};
  std::vector<Point> result{ring.front()};
  result.insert(result.end(), ring.rbegin(), ring.rend() - 1);
  return result;
}

/// The walls of the buildings of a block in plan, to find where those of two buildings coincide. The answer is exact, since plans
/// have whole centimetres.
class TouchingWalls {
 public:
  explicit TouchingWalls(std::span<const BuildingPlan> plans);

  /// Whether a wall of another building than `building` overlaps the axis-parallel segment from a to b (plan frame).
  [[nodiscard]] bool touches(std::size_t building, Point2d a, Point2d b) const;
  /// Whether a wall of another building touches any wall of this one.
  [[nodiscard]] bool touches_any(std::size_t building) const;

 private:
  struct Line {
    std::size_t building;
    std::array<std::int64_t, 2> low_cm, high_cm;
  };
  [[nodiscard]] static Line line_of(std::size_t building, Point2d a, Point2d b);
  [[nodiscard]] bool touches(const Line& line) const;

  std::vector<Line> lines_;
};

}  // namespace farlod
