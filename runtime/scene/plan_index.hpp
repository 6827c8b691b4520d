// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

// What triangles do in the plan. PlanIndex and LatticeCrossings ask the same functions, so that both give the same bits.

using PlanTriangle = std::array<Point3f, 3>;

/// A triangle over a place, by its number among those that were given, and its height there.
struct PlanCrossing {
  std::uint32_t triangle = 0;
  float height_m = 0.0F;
  bool operator==(const PlanCrossing&) const = default;
};

/// The rectangle around a triangle.
struct PlanOutline {
  float west, east, south, north;

  [[nodiscard]] bool contains(float x, float y) const { return west <= x && x <= east && south <= y && y <= north; }
};

[[nodiscard]] inline PlanOutline outline_of(const PlanTriangle& t) {
  return {std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y}),
          std::max({t[0].y, t[1].y, t[2].y})};
}

/// Which side of the line from a to b a place is on: left is positive. The ends are taken in one order, whichever way the edge
/// runs, so that both triangles beside it say the same.
[[nodiscard]] inline double side_of(const Point3f& a, const Point3f& b, float x, float y) {
  const bool turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
  const Point3f &from = turned ? b : a, &to = turned ? a : b;
  const double side = (double{to.x} - from.x) * (double{y} - from.y) - (double{to.y} - from.y) * (double{x} - from.x);
  return turned ? -side : side;
}

/// Twice the area in the plan; negative where the corners run clockwise.
[[nodiscard]] inline double plan_area(const PlanTriangle& t) { return side_of(t[0], t[1], t[2].x, t[2].y); }

/// Whether a triangle lies over a place. Along the line of a sliver, rounding alone would say so beyond its ends, too.
[[nodiscard]] inline bool covers(const PlanTriangle& t, float x, float y) {
  if (!outline_of(t).contains(x, y)) return false;
  const double ab = side_of(t[0], t[1], x, y), bc = side_of(t[1], t[2], x, y), ca = side_of(t[2], t[0], x, y);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

/// The height of a triangle that covers a place.
[[nodiscard]] inline float height_at(const PlanTriangle& t, float x, float y) {
  const double ux = double{t[1].x} - t[0].x, uy = double{t[1].y} - t[0].y, uz = double{t[1].z} - t[0].z;
  const double vx = double{t[2].x} - t[0].x, vy = double{t[2].y} - t[0].y, vz = double{t[2].z} - t[0].z;
  const double px = double{x} - t[0].x, py = double{y} - t[0].y, area = ux * vy - uy * vx;
  const double z = (uz * (px * vy - py * vx) + vz * (ux * py - uy * px)) / area;
  // Beyond its corners no triangle is higher, whatever rounding says
  const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
  return std::clamp(static_cast<float>(t[0].z + z), low, high);
}

/// Finds the triangles above and below points of the plan. Vertical triangles, whose area in the plan is 0, are left out.
///   (1) a point on the common edge of two triangles lies in both, and no point falls between them: on which side of an edge a
///       point lies does not depend on the triangle
class PlanIndex {
 public:
  explicit PlanIndex(std::vector<PlanTriangle> triangles);

  /// Appends the crossings of a place, in the order of the triangles.
  void find(float x, float y, std::vector<PlanCrossing>& crossings) const;

 private:
  /// Chooses the squares: how many there are along an edge, and where they lie.
  void lay_out_squares();
  /// Calls `visit(square, triangle)` for each square that the outline of a triangle touches.
  template <class Visit>
  void for_each_square(const Visit& visit) const;
  [[nodiscard]] std::size_t column_of(float x) const;
  [[nodiscard]] std::size_t row_of(float y) const;

  std::vector<PlanTriangle> triangles_;
  Point3f low_;
  float per_x_ = 0.0F, per_y_ = 0.0F;
  std::size_t edge_ = 0;                           ///< squares along either side
  std::vector<std::uint32_t> first_of_, numbers_;  ///< the triangles of each square, row by row
};

/// Places of the plan in rows and columns at equal distances, such as the centres of pixels. The frame of the plan may be turned
/// against them.
struct PlanLattice {
  std::size_t columns = 0, rows = 0;
  Point2d first_m;          ///< the place in column 0 of row 0
  Point2d column_m;         ///< from a column to the next; from a row to the next is as far, at right angles to the right
  double rounding_m = 0;    ///< no place is farther than this from where its row and its column say
  std::vector<float> x, y;  ///< of each place, row by row

  [[nodiscard]] Point2d row_m() const { return {column_m.y, -column_m.x}; }
};

/// Finds the triangles above and below all places of a lattice, triangle by triangle: those of a row that a triangle covers lie
/// side by side. Finds at each place what PlanIndex finds there, to the bit.
class LatticeCrossings {
 public:
  /// Forgets what was found before. The lattice has fewer than 2³² places.
  void find(std::span<const PlanTriangle> triangles, const PlanLattice& lattice);
  /// The crossings of the n-th place, in the order of the triangles.
  [[nodiscard]] std::span<const PlanCrossing> at(std::size_t n) const {
    return std::span(crossings_).subspan(first_of_[n], first_of_[n + 1] - first_of_[n]);
  }

 private:
  struct Found {
    std::uint32_t place;
    PlanCrossing crossing;
  };
  void add(std::uint32_t number, const PlanTriangle& triangle, const PlanLattice& lattice);
  void sort_by_place(std::size_t places);

  std::vector<Found> found_;
  std::vector<std::size_t> first_of_;
  std::vector<PlanCrossing> crossings_;
};

}  // namespace farlod
