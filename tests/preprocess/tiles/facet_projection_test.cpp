// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/facet_projection.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace farlod::tiles {
namespace {

/// Coordinates below 16, normals of length 1 of which the largest part is at least 1/√3: a dozen sums and products, one quotient.
constexpr double projection_rounding_m = 12 * 16 * 1.7321 * std::numeric_limits<double>::epsilon();

TEST(FacetProjection, LiftsBackWhatItLaidFlat) {
  const Point3d origin{1, -2, 3};
  for (const Point3d& n : {Point3d{0.1, 0.2, 1}, {1, 0.2, -0.3}, {0.3, -1, 0.2}, {-1, 0.1, 0.1}, {0.2, 1, 0.9}, {0, 0, -1}}) {
    const Point3d normal = normalized(n), u = normalized(cross(normal, Point3d{0.3, 0.4, -0.5})), v = cross(normal, u);
    for (const FacetProjection& project :
         {FacetProjection::dropping_a_coordinate(normal), FacetProjection::onto_plane(origin, normal)})
      for (const Point2d in_plane : {Point2d{0, 0}, {5, 0}, {-3, 7}, {0.25, -8}}) {
        const Point3d p = origin + in_plane.x * u + in_plane.y * v;
        EXPECT_LE(norm(project.lift(project(p), origin) - p), projection_rounding_m);
      }
  }
}

TEST(FacetProjection, TellsWhetherItMirrors) {
  const Point3d origin{1, -2, 3};
  for (const Point3d& n :
       {Point3d{0.1, 0.2, 1}, {0.1, 0.2, -1}, {1, 0.2, -0.3}, {-1, 0.2, -0.3}, {0.3, 1, 0.2}, {0.3, -1, 0.2}}) {
    const Point3d normal = normalized(n), u = normalized(cross(normal, Point3d{0.3, 0.4, -0.5})), v = cross(normal, u);
    for (const FacetProjection& project :
         {FacetProjection::dropping_a_coordinate(normal), FacetProjection::onto_plane(origin, normal)}) {
      const Point2d a = project(origin), b = project(origin + u) - a, c = project(origin + v) - a;
      EXPECT_EQ(b.x * c.y - b.y * c.x < 0.0, project.is_mirrored());
    }
  }
}

TEST(FacetProjection, KeepsDistancesInItsOwnPlaneOnly) {
  const Point3d normal = normalized(Point3d{0, -1, 1}), along_slope{0, 3, 3};
  const FacetProjection flat = FacetProjection::onto_plane({}, normal),
                        from_above = FacetProjection::dropping_a_coordinate(normal);
  EXPECT_NEAR(norm(flat(along_slope)), norm(along_slope), projection_rounding_m);
  EXPECT_EQ(norm(from_above(along_slope)), 3.0);
}

}  // namespace
}  // namespace farlod::tiles
