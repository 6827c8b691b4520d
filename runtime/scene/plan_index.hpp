// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "farlod/point.hpp"
#include "scene/plan_triangle.hpp"

namespace farlod {

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

}  // namespace farlod
