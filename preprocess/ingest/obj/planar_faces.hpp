// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::ingest {

/// The step to which exporters of meshes round coordinates.
inline constexpr double coordinate_rounding_m = 1e-3;

/// A triangle thinner than this has no reliable normal. Rounding moves each coordinate by up to half a step, hence a point by up
/// to √3/2 steps. The two points that span the thickness can move in opposite directions.
inline constexpr double thinnest_face_m = 1.7320508075688772 * coordinate_rounding_m;

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
