// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/datasets/generator/point_in_city.hpp"

#include <cmath>

#include "generator/convex_faces.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

double turn(const Point3d& a, const Point3d& b, const Point3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Seen from above; the face may look up or down.
bool covers(const ConvexFace& face, const Point3d& p) {
  const double sign = face.normal.z > 0.0 ? 1.0 : -1.0;
  for (std::size_t k = 0; k < face.corners.size(); ++k)
    if (sign * turn(face.corners[k], face.corners[(k + 1) % face.corners.size()], p) < 0.0) return false;
  return true;
}

}  // namespace

std::vector<ConvexFace> convex_faces_of(const GeneratedBuilding& building) {
  std::vector<ConvexFace> faces;
  for (const GeneratedFacet& facet : building.facets)
    for (const FaceRing& ring : convex_faces(facet, building.vertices)) {
      ConvexFace& face = faces.emplace_back();
      face.role = facet.role;
      for (const std::uint32_t k : ring) face.corners.push_back(as_double(building.vertices[k]));
      Point3d sum;
      for (std::size_t k = 1; k + 1 < ring.size(); ++k)
        sum = sum + cross(face.corners[k] - face.corners[0], face.corners[k + 1] - face.corners[0]);
      face.normal = normalized(sum);
    }
  return faces;
}

bool is_inside(const Point3d& p, const std::vector<ConvexFace>& building) {
  // Upright faces count for nothing: the ray runs along them
  constexpr double upright = 1e-3;
  int crossings = 0;
  for (const ConvexFace& face : building) {
    if (std::abs(face.normal.z) < upright || !covers(face, p)) continue;
    const double height_mm = dot(face.normal, face.corners[0] - p) / face.normal.z;
    if (height_mm > 0.0) crossings += face.normal.z > 0.0 ? 1 : -1;
  }
  return crossings > 0;
}

bool is_on(const Point3d& p, const ConvexFace& face, double tolerance_mm) {
  if (std::abs(dot(face.normal, p - face.corners[0])) > tolerance_mm) return false;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Point3d edge = normalized(face.corners[(k + 1) % face.corners.size()] - face.corners[k]);
    if (dot(cross(edge, p - face.corners[k]), face.normal) < -tolerance_mm) return false;
  }
  return true;
}

}  // namespace farlod
