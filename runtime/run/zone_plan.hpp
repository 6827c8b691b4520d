// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "scene/convex_piece.hpp"

namespace farlod {

/// A side of a zone, by y: low.y < high.y.
struct ZoneEdge {
  Point2d low, high;
};

/// A part of a zone between two lines of constant y, and between two of its sides.
struct ZoneTrapezoid {
  double y_low = 0.0, y_high = 0.0;
  ZoneEdge west, east;

  [[nodiscard]] Box2d outline() const;
  [[nodiscard]] double area_m2() const;
  /// The same in a frame whose origin is at `corner`. Two zones that share a side have the same plane there to the bit.
  [[nodiscard]] ZoneTrapezoid moved_to(Point2d corner) const;
  [[nodiscard]] bool contains(Point2d p) const;
  /// Where it lies on a line of constant y: empty where the second is not larger.
  [[nodiscard]] std::array<double, 2> span_at(double y) const;
  /// What of a piece lies above or below it.
  [[nodiscard]] ConvexPiece part_of(const ConvexPiece& piece) const;
};

/// What lies in an odd number of rings, as trapezoids that do not overlap. Rings may touch, and cross in corners only.
[[nodiscard]] std::vector<ZoneTrapezoid> trapezoids_of(const std::vector<std::vector<Point2d>>& rings);

/// What of a piece lies in any of them.
[[nodiscard]] std::vector<ConvexPiece> parts_within(const ConvexPiece& piece, const std::vector<ZoneTrapezoid>& trapezoids);

}  // namespace farlod
