// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh_view.hpp"

namespace farlod::far_terrain {

/// Heights at the nodes of a square, row by row; NaN where there is none.
struct HeightsOfSquare {
  std::span<const float> height_m;
  std::span<const float> tolerance_m;  ///< for each node: by how much its height may be off
};

/// Triangulates squares of heights with as few right triangles as keep a tolerance: a right-triangulated irregular network, or
/// RTIN (W. Evans, D. Kirkpatrick, G. Townsend, "Right-triangulated irregular networks", Algorithmica 30, 2001).
///   (1) no triangle is left whole where a node halves its hypotenuse, or one within it, and is farther from that, upright, than
///       the tolerance. What adds up over the levels is not measured; in rough ground it is up to half a tolerance more
///   (2) there is no triangle over a node without a height, nor beside one
class RightTriangles {
 public:
  /// Squares of (side + 1)² nodes; `side` is a power of two, up to 256.
  explicit RightTriangles(std::uint32_t side);

  [[nodiscard]] std::uint32_t nodes_along() const { return side_ + 1; }
  /// Corners are numbers of nodes; the right angle is at the third.
  [[nodiscard]] std::vector<Triangle> triangulate(const HeightsOfSquare& heights);

 private:
  /// One of the tree of all triangles that can be halved. The halves have the legs for hypotenuses.
  struct Halvable {
    std::uint32_t a, b, right_angle;  ///< numbers of nodes; a and b are the ends of the hypotenuse
    bool has_halvable_halves;
  };
  void measure(const HeightsOfSquare& heights);
  void divide(const HeightsOfSquare& heights, const Triangle& t, std::vector<Triangle>& triangles) const;

  std::uint32_t side_;
  std::vector<Halvable> halvable_;  ///< from large to small
  /// For each node, the largest error, as a share of the tolerance, of a triangle whose hypotenuse it halves, and of all within.
  std::vector<float> excess_;
};

}  // namespace farlod::far_terrain
