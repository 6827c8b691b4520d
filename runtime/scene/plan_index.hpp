// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// Finds the triangles above and below places of the plan. Upright triangles, which cover nothing in the plan, do not count.
///   (1) a place on the common edge of two triangles is in both, and no place falls between them: the side of an edge that a
///       place is on does not depend on the triangle
class PlanIndex {
 public:
  using Corners = std::array<Point3f, 3>;

  /// A triangle over a place, by its number among those that were given, and its height there.
  struct Crossing {
    std::uint32_t triangle = 0;
    float height_m = 0.0F;
  };

  explicit PlanIndex(std::vector<Corners> triangles);

  /// Appends the crossings of a place, in the order of the triangles.
  void find(float x, float y, std::vector<Crossing>& crossings) const;

 private:
  [[nodiscard]] std::size_t column_of(float x) const;
  [[nodiscard]] std::size_t row_of(float y) const;

  std::vector<Corners> triangles_;
  Point3f low_;
  float per_x_ = 0.0F, per_y_ = 0.0F;
  std::size_t edge_ = 0;                           ///< squares along either side
  std::vector<std::uint32_t> first_of_, numbers_;  ///< the triangles of each square, row by row
};

}  // namespace farlod
