// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "farlod/expects.hpp"
#include "generator/generated_building.hpp"

namespace farlod {

using LotRing = std::vector<Point2d>;

/// Puts facets given in a lot's frame together to a solid in the city frame. Corners that are the same millimetre become one
/// vertex, so that neighbouring facets share their edges.
class SolidBuilder {
 public:
  SolidBuilder(const LotFrame& lot, const PlanRotation& rotation, double base_m)
      : lot_(lot), rotation_(rotation), base_mm_(millimetres(base_m)) {}

  /// Corners counter-clockwise seen from outside; z counts from the base.
  void add_facet(FacetRole role, std::span<const Point3d> outer_lot, std::span<const Point3d> hole_lot = {});
  /// A horizontal facet at height z over a counter-clockwise ring and around a counter-clockwise hole.
  void add_cap(FacetRole role, const LotRing& ring, double z_m, const LotRing& hole = {});
  /// An upright rectangle over the edge from a to b; it looks to the right of that direction.
  void add_wall(Point2d a, Point2d b, double low_m, double high_m);
  /// Walls over all edges of a counter-clockwise ring.
  void add_walls(const LotRing& ring, double low_m, double high_m);
  void set_footprint(const LotRing& ring, const LotRing& hole);

  /// The solid; the builder is empty afterwards.
  [[nodiscard]] GeneratedBuilding finish();

 private:
  [[nodiscard]] PointMm city_from_lot(const Point3d& p_lot) const;
  [[nodiscard]] std::uint32_t vertex(const Point3d& p_lot);
  [[nodiscard]] std::vector<std::uint32_t> vertices(std::span<const Point3d> ring_lot);

  LotFrame lot_;
  PlanRotation rotation_;
  std::int64_t base_mm_;
  GeneratedBuilding building_;
};

/// The ring walked the other way, from the same corner.
template <class Point>
[[nodiscard]] std::vector<Point> reversed_ring(const std::vector<Point>& ring) {
  if (ring.empty()) return {};
  std::vector<Point> result{ring.front()};
  result.insert(result.end(), ring.rbegin(), ring.rend() - 1);
  return result;
}

}  // namespace farlod
