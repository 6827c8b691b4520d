// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tiles/ground.hpp"

namespace farlod::tiles::test {

/// All faces of a ground, some at a time.
[[nodiscard]] inline std::vector<GroundFace> faces_of(const Ground& ground) {
  std::vector<GroundFace> all;
  GroundFaces faces(ground);
  for (auto some = faces.next(7); !some.empty(); some = faces.next(7)) all.insert(all.end(), some.begin(), some.end());
  return all;
}

[[nodiscard]] inline std::vector<std::array<Point3d, 3>> triangles_of(const Ground& ground) {
  std::vector<std::array<Point3d, 3>> triangles;
  for (const GroundFace& face : faces_of(ground)) triangles.push_back(face.corners);
  return triangles;
}

[[nodiscard]] inline std::vector<HorizonSegment> horizon_edges_of(const Ground& ground) {
  std::vector<HorizonSegment> edges;
  for (const GroundFace& face : faces_of(ground)) {
    const std::vector<HorizonSegment> own = face.horizon_edges();
    edges.insert(edges.end(), own.begin(), own.end());
  }
  return edges;
}

}  // namespace farlod::tiles::test
