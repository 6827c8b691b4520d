// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/convex_faces.hpp"

#include <gtest/gtest.h>

#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

/// Whether no corner of the face turns against its sense by more than rounding can do: a corner moves by at most √3/2 mm, so
/// that the cross product of two edges changes by at most √3 mm times their lengths, plus the product of the two changes.
bool is_convex(const FaceRing& face, std::span<const PointMm> vertices) {
  const auto as_double = [](const PointMm& p) {
    return Point3d{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  };
  const Point3d sense = normalized(as_double(twice_area_mm2(face, vertices)));
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Point3d a = as_double(vertices[face[(k + 1) % face.size()]] - vertices[face[k]]);
    const Point3d b = as_double(vertices[face[(k + 2) % face.size()]] - vertices[face[(k + 1) % face.size()]]);
    const double change_mm = 2.0 * planarity_mm;
    if (dot(cross(a, b), sense) < -change_mm * (norm(a) + norm(b) + change_mm)) return false;
  }
  return true;
}

TEST(ConvexFaces, AreConvexClosedAndOfTheSameVolume) {
  for (const CitySettings& settings : cities_of_all_shapes())
    for (const GeneratedBuilding& building : all_buildings(settings)) {
      std::vector<FaceRing> faces;
      for (const GeneratedFacet& facet : building.facets)
        for (FaceRing& face : convex_faces(facet, building.vertices)) faces.push_back(std::move(face));
      for (const FaceRing& face : faces) ASSERT_TRUE(is_convex(face, building.vertices)) << building.id;
      ASSERT_TRUE(is_closed(faces)) << building.id;
      ASSERT_GT(six_volumes_mm3(faces, building.vertices), 0) << building.id;
    }
}

TEST(ConvexFaces, AFrameBecomesOneFaceForEachSide) {
  const std::vector<PointMm> vertices{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}};
  const std::vector<FaceRing> faces = convex_faces({FacetRole::roof, {0, 1, 2, 3}, {4, 5, 6, 7}}, vertices);
  EXPECT_EQ(faces, (std::vector<FaceRing>{{0, 1, 7, 4}, {1, 2, 6, 7}, {2, 3, 5, 6}, {3, 0, 4, 5}}));
}

TEST(ConvexFaces, AnLBecomesTwo) {
  const std::vector<PointMm> vertices{{0, 0, 0}, {9, 0, 0}, {9, 3, 0}, {3, 3, 0}, {3, 9, 0}, {0, 9, 0}};
  EXPECT_EQ(convex_faces({FacetRole::roof, {0, 1, 2, 3, 4, 5}, {}}, vertices),
            (std::vector<FaceRing>{{3, 4, 5, 0}, {3, 0, 1, 2}}));
}

}  // namespace
}  // namespace farlod
