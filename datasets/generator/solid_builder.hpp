// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "generator/plan_solid.hpp"

namespace farlod {

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

}  // namespace farlod
