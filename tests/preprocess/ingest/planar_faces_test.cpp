// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/obj/planar_faces.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace farlod::ingest {
namespace {

using Numbers = std::vector<std::uint32_t>;

FaceCorners faces(const std::vector<std::vector<Point3d>>& polygons) {
  FaceCorners mesh;
  for (const auto& polygon : polygons) {
    mesh.points.insert(mesh.points.end(), polygon.begin(), polygon.end());
    mesh.end_face();
  }
  return mesh;
}

/// A square of edge 10 m cut along its diagonal; one corner lifted.
FaceCorners folded_square(double lift_m) {
  return faces({{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}, {{0, 0, 0}, {10, 10, 0}, {0, 10, lift_m}}});
}

TEST(PlanarFaces, TrianglesOfASquareAreOneFace) { EXPECT_EQ(number_planar_faces(folded_square(0.0)), (Numbers{0, 0})); }

TEST(PlanarFaces, RoundingDoesNotSplitAFace) {
  // Mirrored in the diagonal, the apex of the other triangle has the coordinates (1, -1, 1) among its corners. All four points
  // may be half a step off, and the normal is upright: 4 · ½ step is the limit
  EXPECT_EQ(number_planar_faces(folded_square(1.99 * coordinate_rounding_m)), (Numbers{0, 0}));
  EXPECT_EQ(number_planar_faces(folded_square(2.05 * coordinate_rounding_m)), (Numbers{0, 1}));
}

TEST(PlanarFaces, ParallelFacesWithoutACommonEdgeStayApart) {
  EXPECT_EQ(number_planar_faces(faces({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {2, 0, 0}, {1, -1, 0}}})), (Numbers{0, 1}));
}

TEST(PlanarFaces, AThinFaceJoinsOneNeighborAndLinksNone) {
  const Point3d a{0, 0, 0}, b{10, 0, 0}, on_edge{5, 0, 0};
  const FaceCorners mesh = faces({{a, b, {5, 10, 0}}, {a, on_edge, b}, {on_edge, a, {2, 0, -10}}});
  EXPECT_EQ(number_planar_faces(mesh), (Numbers{0, 1, 1}));
}

TEST(PlanarFaces, UnreadablePointsJoinNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FaceCorners mesh =
      faces({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, nan, 1}}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}});
  EXPECT_EQ(number_planar_faces(mesh), (Numbers{0, 1, 2}));
}

TEST(PlanarFaces, WeldingFindsEqualPoints) {
  const std::vector<Point3d> points{{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}};
  const Numbers numbers = weld(points);
  EXPECT_EQ(numbers[0], numbers[2]);
  EXPECT_EQ(numbers[1], numbers[3]);
  EXPECT_NE(numbers[0], numbers[1]);
}

}  // namespace
}  // namespace farlod::ingest
