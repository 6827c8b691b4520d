// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::tiles::test {

/// The rule of misplaced holes, word for word: each ring with each ring, each edge with each edge.
class PairwiseRings {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;
  using Outline = std::vector<Point>;

  explicit PairwiseRings(const std::vector<std::vector<Point2d>>& rings) : is_misplaced(rings.size(), false) {
    for (const auto& ring : rings) {
      outlines_.emplace_back();
      for (const Point2d& p : ring) outlines_.back().emplace_back(p.x, p.y);
    }
    place();
  }

  static CGAL::Bounded_side side_of(const Point& p, const Outline& ring) {
    return CGAL::bounded_side_2(ring.begin(), ring.end(), p, Kernel());
  }

  static bool rings_cross(const Outline& a, const Outline& b) {
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
      if (has_corner_on(*one, *other, CGAL::ON_BOUNDED_SIDE) && has_corner_on(*one, *other, CGAL::ON_UNBOUNDED_SIDE)) return true;
    for (std::size_t j = 0; j < a.size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k)
        if (edges_cross(a[j], a[(j + 1) % a.size()], b[k], b[(k + 1) % b.size()])) return true;
    return false;
  }

  std::optional<std::size_t> true_outer;
  std::vector<bool> is_misplaced;

 private:
  static bool are_same(const Outline& a, Outline b) {
    if (a.size() != b.size()) return false;
    for (int way = 0; way < 2; ++way) {
      for (std::size_t turn = 0; turn < b.size(); ++turn) {
        if (a == b) return true;
        std::rotate(b.begin(), b.begin() + 1, b.end());
      }
      std::reverse(b.begin(), b.end());
    }
    return false;
  }

  static CGAL::Bounded_side side_of(const Outline& other, const Outline& ring) {
    for (const Point& p : other)
      if (const auto side = side_of(p, ring); side != CGAL::ON_BOUNDARY) return side;
    for (std::size_t k = 0; k < other.size(); ++k)
      if (const auto side = side_of(CGAL::midpoint(other[k], other[(k + 1) % other.size()]), ring); side != CGAL::ON_BOUNDARY)
        return side;
    return CGAL::ON_BOUNDARY;
  }

  static bool edges_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
    return CGAL::orientation(a, b, c) * CGAL::orientation(a, b, d) < 0 &&
           CGAL::orientation(c, d, a) * CGAL::orientation(c, d, b) < 0;
  }

  static bool has_corner_on(const Outline& other, const Outline& ring, CGAL::Bounded_side side) {
    return std::any_of(other.begin(), other.end(), [&](const Point& p) { return side_of(p, ring) == side; });
  }

  [[nodiscard]] bool lies_in(std::size_t inner, std::size_t outer) const {
    return side_of(outlines_[inner], outlines_[outer]) == CGAL::ON_BOUNDED_SIDE &&
           !rings_cross(outlines_[inner], outlines_[outer]);
  }

  void place() {
    for (std::size_t k = 1; k < outlines_.size() && !true_outer; ++k)
      if (!are_same(outlines_[0], outlines_[k]) && lies_in(0, k)) true_outer = k;
    const std::size_t outer = true_outer.value_or(0);
    for (std::size_t k = 0; k < outlines_.size(); ++k)
      if (k != outer)
        is_misplaced[k] =
            are_same(outlines_[outer], outlines_[k]) ||
            (side_of(outlines_[k], outlines_[outer]) == CGAL::ON_UNBOUNDED_SIDE && !rings_cross(outlines_[outer], outlines_[k]));
    for (std::size_t k = 0; k < outlines_.size(); ++k)
      for (std::size_t j = 0; j < outlines_.size() && !is_misplaced[k]; ++j)
        if (j != k && j != outer && k != outer && !is_misplaced[j]) compare(j, k);
  }

  void compare(std::size_t j, std::size_t k) {
    if (are_same(outlines_[j], outlines_[k]))
      is_misplaced[std::max(j, k)] = true;
    else if (lies_in(k, j))
      is_misplaced[k] = true;
  }

  std::vector<Outline> outlines_;
};

}  // namespace farlod::tiles::test
