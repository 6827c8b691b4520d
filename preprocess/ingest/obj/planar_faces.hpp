// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::ingest {

/// Exporters of meshes round coordinates to the millimetre.
inline constexpr double coordinate_rounding_m = 1e-3;

/// A triangle thinner than this has no normal: rounding moves each coordinate by half a step, so a point by √3/2 steps, and
/// the two points that span the thickness can move against each other.
inline constexpr double thinnest_face_m = 1.7320508075688772 * coordinate_rounding_m;

/// Polygons of a mesh, corner by corner: face f has the corners [first_corner[f], first_corner[f + 1]).
struct FaceCorners {
  std::vector<Point3d> points;
  std::vector<std::uint32_t> first_corner{0};

  [[nodiscard]] std::size_t face_count() const { return first_corner.size() - 1; }
  [[nodiscard]] std::span<const Point3d> face(std::size_t f) const {
    return std::span(points).subspan(first_corner[f], first_corner[f + 1] - first_corner[f]);
  }
  void end_face() { first_corner.push_back(static_cast<std::uint32_t>(points.size())); }
};

/// Numbers points: equal coordinates, equal number.
[[nodiscard]] std::vector<std::uint32_t> weld(std::span<const Point3d> points);

/// The number of the planar face that each face of the mesh is a piece of, counted in the order of the faces.
///   (1) Faces belong together when they share an edge and are coplanar as far as rounded coordinates can tell: the apex of
///       one lies no farther from the plane of the other than half a rounding step of all four points explains.
///   (2) A face thinner than rounding has no plane: it joins one neighbor, and never links two.
[[nodiscard]] std::vector<std::uint32_t> number_planar_faces(const FaceCorners& mesh);

}  // namespace farlod::ingest
