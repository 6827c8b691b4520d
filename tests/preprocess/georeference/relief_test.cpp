// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Terrain that files bring along.
#include <gmock/gmock.h>

#include <limits>

#include "farlod/error.hpp"
#include "georeference/georeference.hpp"
#include "tests/preprocess/georeference/small_source.hpp"

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Point3d rotterdam{92461.0, 436007.0, 3.0};

SourceCity relief_with(const std::string& crs, std::vector<Point3d> points) {
  SourceCity source;
  source.source = "relief.gml";
  source.crs.definition = crs;
  source.relief_points = std::move(points);
  return source;
}

/// One triangle of a relief, with a step of that size.
std::vector<Point3d> triangle(const Point3d& first, double step) {
  return {first, first + Point3d{step, 0, 0}, first + Point3d{0, step, 1}};
}

TEST(Relief, GoesWithItsBuildings) {
  SourceCity source = source_with("EPSG:28992", rotterdam, 10.0);
  source.relief_points = triangle(rotterdam, 500.0);
  Report report;
  const LocatedCity located = georeference({source}, {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  EXPECT_EQ(located.georeference.origin_m, (Point2d{92466.0, 436012.0})) << "the buildings' centre, whatever the relief";
  EXPECT_THAT(located.relief_points, ElementsAre(Point3d{-5, -5, 3}, Point3d{495, -5, 3}, Point3d{-5, 495, 4}));
}

TEST(Relief, IsCountedAsItsFileCounts) {
  SourceCity source = source_with("EPSG:2263", {1025000.0, 172918.0, 100.0}, 30.0);
  source.relief_points = {{1025000.0, 172918.0, 100.0}};
  Report report;
  const LocatedCity located = georeference({source}, {}, report);
  EXPECT_THAT(located.relief_points, ElementsAre(located.city.points()[0])) << "in metres, like a building's vertex there";
}

TEST(Relief, MayComeInAFileOfItsOwnAndInAnotherCrs) {
  const Point3d lat_lon{51.90876, 4.44, 3.0};
  Report report;
  const LocatedCity located =
      georeference({source_with("EPSG:28992", rotterdam, 10.0), relief_with("EPSG:4326", triangle(lat_lon, 1e-3)),
                    relief_with("EPSG:28992", triangle(rotterdam, 20.0))},
                   {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  ASSERT_EQ(located.relief_points.size(), 6u) << "file by file";
  EXPECT_EQ(located.relief_points[3], (Point3d{-5, -5, 3}));
  const double degree_of_latitude_m = located.relief_points[1].y - located.relief_points[0].y;
  constexpr double flattening = 1.0 / 298.0;
  EXPECT_NEAR(degree_of_latitude_m, 111.2, 2.0 * 111.2 * flattening) << "latitude first, a thousandth of a degree";
}

TEST(Relief, IsACityOnItsOwn) {
  Report report;
  const LocatedCity located = georeference({relief_with("EPSG:28992", triangle(rotterdam, 100.0))}, {}, report);
  EXPECT_THAT(report.problems(), IsEmpty());
  EXPECT_TRUE(located.city.buildings().empty());
  EXPECT_EQ(located.georeference.origin_m, (Point2d{92511.0, 436057.0})) << "its own centre";
  EXPECT_EQ(located.relief_points[0], (Point3d{-50, -50, 3}));
}

TEST(Relief, LosesPointsThatLieNowhereAndSaysSoOnce) {
  std::vector<Point3d> points = triangle(rotterdam, 100.0);
  points.insert(points.begin() + 1, 2, {1e30, 0.0, 0.0});
  Report report;
  const LocatedCity located = georeference({relief_with("EPSG:28992", points)}, {}, report);
  EXPECT_EQ(located.relief_points.size(), 3u);
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::outside_of_projection);
  EXPECT_EQ(report.problems()[0].source, "relief.gml");
  EXPECT_THAT(report.problems()[0].detail, AllOf(HasSubstr("2 of 5 points"), HasSubstr("1e+30")));
}

TEST(Relief, IsNotTakenForDegreesNorDegreesForMetres) {
  Report report;
  EXPECT_THROW((void)georeference({relief_with("EPSG:25832", triangle({8.5, 50.1, 3.0}, 1e-3))}, {}, report), InputError);
  EXPECT_THROW((void)georeference({relief_with("EPSG:4326", triangle({500000, 5600000, 3.0}, 10.0))}, {}, report), InputError);
}

TEST(Relief, MayBeOnePoint) {
  Report report;
  EXPECT_EQ(georeference({relief_with("EPSG:28992", {rotterdam, rotterdam})}, {}, report).relief_points.size(), 2u);
}

}  // namespace
}  // namespace farlod::georeference
