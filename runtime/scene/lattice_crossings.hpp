// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "scene/plan_triangle.hpp"

namespace farlod {

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
