// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::ingest {

/// Union-find. The representative of a set is its smallest member, so that it does not depend on the order of joins.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  [[nodiscard]] std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[a < b ? b : a] = a < b ? a : b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The step to which exporters of meshes round coordinates.
inline constexpr double coordinate_rounding_m = 1e-3;

/// The corners of the polygons of a mesh: face f has the corners [first_corner[f], first_corner[f + 1]).
struct FaceCorners {
  std::vector<Point3d> points;
  std::vector<std::uint32_t> first_corner{0};

  [[nodiscard]] std::size_t face_count() const { return first_corner.size() - 1; }
  [[nodiscard]] std::span<const Point3d> face(std::size_t f) const {
    return std::span(points).subspan(first_corner[f], first_corner[f + 1] - first_corner[f]);
  }
  void end_face() { first_corner.push_back(static_cast<std::uint32_t>(points.size())); }
};

/// Numbers points. Points with equal coordinates have the same number.
[[nodiscard]] std::vector<std::uint32_t> weld(std::span<const Point3d> points);

/// The number of the planar face that each face of the mesh belongs to, counted in the order of the faces.
///   (1) Two faces belong together if they share an edge and are coplanar within the rounding of coordinates: the apex of one
///   lies
///       no farther from the plane of the other than a movement of all four points by half a rounding step can explain.
///   (2) A face thinner than the rounding has no plane. It joins one neighbor, and never connects two.
[[nodiscard]] std::vector<std::uint32_t> number_planar_faces(const FaceCorners& mesh);

}  // namespace farlod::ingest
