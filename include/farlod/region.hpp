// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/export.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// A part of the map, in the package's CRS: what lies in an odd number of rings, which are the outlines of polygons and of their
/// holes. Immutable; any number of threads may ask it.
class FARLOD_EXPORT Region {
 public:
  /// The points of an outline in order; whether the first is repeated at the end does not matter. One of fewer than three points
  /// holds nothing.
  using Ring = std::vector<Point2d>;
  /// Throws InvalidArgument where a coordinate is no number, or larger than 1e8 m.
  explicit Region(const std::vector<Ring>& rings);

  /// A place on an outline belongs to one side of it, and where two polygons share an edge, to one of the two.
  [[nodiscard]] bool contains(Point2d p) const;
  [[nodiscard]] const Box2d& outline() const { return outline_; }

 private:
  struct Edge {
    Point2d low, high;  ///< by y
  };
  [[nodiscard]] std::size_t band_of(double y) const;

  Box2d outline_;
  std::vector<Edge> edges_;
  // The edges that reach into each of equal bands of y: numbers_[first_of_band_[b] … first_of_band_[b + 1])
  std::size_t bands_ = 1;
  std::vector<std::size_t> first_of_band_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace farlod
