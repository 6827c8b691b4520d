// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "generator/generated_building.hpp"

namespace farlod {

/// A convex face of a building, in millimetres of the city frame.
struct ConvexFace {
  FacetRole role;
  std::vector<Point3d> corners;
  Point3d normal;  ///< of length 1, outwards
};
[[nodiscard]] std::vector<ConvexFace> convex_faces_of(const GeneratedBuilding& building);

/// Whether a point is inside a closed building: whether a ray upwards leaves it once more than it enters it.
[[nodiscard]] bool is_inside(const Point3d& p, const std::vector<ConvexFace>& building);
/// Whether a point lies on a face, up to so many millimetres.
[[nodiscard]] bool is_on(const Point3d& p, const ConvexFace& face, double tolerance_mm);

}  // namespace farlod
