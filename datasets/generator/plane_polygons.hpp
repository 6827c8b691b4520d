// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

using PlanePolygon = std::vector<Point2d>;

/// The half plane where value(p) = dot(slope, p) + offset ≤ 0.
struct HalfPlane {
  Point2d slope;
  double offset = 0.0;
  [[nodiscard]] double value(Point2d p) const { return dot(slope, p) + offset; }
};

/// Area of a polygon, positive if it runs counter-clockwise.
[[nodiscard]] double area(const PlanePolygon& polygon);
/// Whether no corner of a counter-clockwise polygon turns right.
[[nodiscard]] bool is_convex(const PlanePolygon& polygon);
/// The part of a convex polygon in a half plane; empty if there is none.
[[nodiscard]] PlanePolygon clipped(const PlanePolygon& convex, const HalfPlane& half_plane);
/// The difference of two convex polygons, both counter-clockwise, as convex polygons that do not overlap.
[[nodiscard]] std::vector<PlanePolygon> without(const PlanePolygon& subject, const PlanePolygon& clip);

using GridPoint = std::array<std::int64_t, 2>;
using GridTriangle = std::array<std::uint32_t, 3>;

/// Cuts a polygon with holes into counter-clockwise triangles by ear clipping, in exact arithmetic.
///   (1) no corner is added, and edges stay whole
///   (2) the areas of the triangles sum to that of the polygon
/// `rings` holds numbers of `points`: the outer ring counter-clockwise, then the holes, clockwise. Rings must neither touch nor
/// cross. Differences of coordinates must be below 2^30.
[[nodiscard]] std::vector<GridTriangle> triangles(std::span<const GridPoint> points,
                                                  std::vector<std::vector<std::uint32_t>> rings);

}  // namespace farlod
