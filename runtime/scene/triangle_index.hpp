// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// Triangles by where they are: a tree of boxes. Immutable; threads may share it.
class TriangleIndex {
 public:
  using Corners = std::array<Point3d, 3>;

  explicit TriangleIndex(std::vector<Corners> triangles);

  [[nodiscard]] std::span<const Corners> triangles() const { return triangles_; }

  /// What is asked for: from a place, between an azimuth (its unit vector) and another one to its left by an angle of this
  /// tangent, less than a right angle, and in front of the plane with this normal.
  struct Sector {
    Point3d eye;
    Point2d from;
    double tangent = 0.0;
    Point3d normal;
  };
  /// Takes corners relative to the eye. From then on only those are asked for that rise above the slope that it returns, times
  /// the distance along the first azimuth; none where it is infinite.
  using OnTriangles = std::function<double(std::span<const Corners>)>;
  /// Roughly from near to far:
  ///   (1) told are those triangles that have a corner on the near side of each plane that bounds what is asked for: the upright
  ///       planes of both azimuths, that at right angles to the first one, that of the slope, and that of the normal;
  ///   (2) none is told twice;
  ///   (3) where the slope is raised meanwhile, each is told of which something rises above the last slope in front of the eye.
  void find(const Sector& sector, double slope, const OnTriangles& on_triangles) const;

 private:
  static constexpr std::size_t leaf_triangles = 16;
  struct Box {
    static constexpr double endless = std::numeric_limits<double>::infinity();
    Point3d low{endless, endless, endless}, high{-endless, -endless, -endless};
    void add(const Point3d& p);
  };
  struct Node {
    Box box;
    std::uint32_t first = 0, last = 0;  ///< its triangles
    std::uint32_t second_child = 0;     ///< the first one follows the node; 0 for a leaf
  };
  class Question;
  void add_node(std::uint32_t first, std::uint32_t last);
  void visit(std::uint32_t number, Question& question) const;

  std::vector<Corners> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace farlod
