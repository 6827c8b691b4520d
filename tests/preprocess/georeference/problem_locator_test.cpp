// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/problem_locator.hpp"

#include <gtest/gtest.h>

#include "georeference/georeference.hpp"
#include "tests/preprocess/georeference/small_source.hpp"

namespace farlod::georeference {
namespace {

Problem problem_at(const std::string& source, std::optional<Point3d> position) {
  return {ProblemCode::repeated_id, source, "house", "", position};
}

std::optional<Point2d> lon_lat_of(const char* crs, AxisOrder order, const Point3d& position) {
  const bool swap = order == AxisOrder::northing_first;
  ProblemLocator locator(Crs::find(crs).value(), FileAxes{order}, swap ? Point2d{position.y, position.x} : horizontal(position));
  Problem problem = problem_at("town.gml", position);
  locator.locate(problem);
  return problem.lon_lat_deg;
}

TEST(ProblemLocator, LeavesDegreesOfWgs84AsTheyAre) {
  EXPECT_EQ(lon_lat_of("EPSG:4326", AxisOrder::easting_first, {8.5, 49.25, 3.0}), (Point2d{8.5, 49.25}));
}

TEST(ProblemLocator, ReadsTheFilesAxisOrder) {
  EXPECT_EQ(lon_lat_of("EPSG:4326", AxisOrder::northing_first, {49.25, 8.5, 3.0}), (Point2d{8.5, 49.25}));
}

TEST(ProblemLocator, KnowsNoPlaceBeyondTheEarth) {
  EXPECT_FALSE(lon_lat_of("EPSG:4326", AxisOrder::easting_first, {8.5, 95.0, 3.0}));
  EXPECT_FALSE(lon_lat_of("EPSG:4326", AxisOrder::easting_first, {190.0, 49.25, 3.0}));
  EXPECT_FALSE(lon_lat_of("EPSG:25832", AxisOrder::easting_first, {1e12, 1e12, 3.0}));
}

TEST(ProblemLocator, LeavesAProblemWithoutPositionAlone) {
  ProblemLocator locator(Crs::find("EPSG:4326").value(), FileAxes{}, {8.5, 49.25});
  Problem problem = problem_at("town.gml", std::nullopt);
  locator.locate(problem);
  EXPECT_FALSE(problem.lon_lat_deg);
}

TEST(Georeference, LocatesTheProblemsOfEachFileInItsOwnCrs) {
  SourceCity degrees = source_with("EPSG:4326", {60.0, 8.0, 3.0}, ten_metres_deg);
  SourceCity metres = source_with("EPSG:32632", {500000.0, 6651411.0, 3.0}, 10.0);
  metres.source = "other.gml";
  Report report;
  report.add(problem_at("town.gml", Point3d{60.0, 8.0, 3.0}));
  report.add(problem_at("other.gml", Point3d{500000.0, 6651411.0, 3.0}));
  report.add(problem_at("unread.gml", Point3d{60.0, 8.0, 3.0}));
  (void)georeference({degrees, metres}, {}, report);
  EXPECT_EQ(report.problems()[0].lon_lat_deg, (Point2d{8.0, 60.0})) << "the file has latitude first";
  ASSERT_TRUE(report.problems()[1].lon_lat_deg);
  constexpr double metre_deg = 1.0 / 111.2e3;
  EXPECT_NEAR(report.problems()[1].lon_lat_deg->x, 9.0, metre_deg) << "the central meridian";
  EXPECT_FALSE(report.problems()[2].lon_lat_deg) << "its CRS is not known";
}

TEST(Georeference, TellsWhereAStrayBuildingLiesInTheFilesOwnAxes) {
  SourceCity source = source_with("EPSG:4326", {60.0, 8.0, 3.0}, ten_metres_deg);
  add_building(source.city, "stray", {{95.0, 8.0, 3.0}, {95.0, 8.1, 3.0}, {95.1, 8.0, 3.0}});
  add_building(source.city, "last", {{60.0, 8.001, 3.0}, {60.0, 8.0012, 3.0}, {60.001, 8.0, 3.0}});
  Report report;
  (void)georeference({source}, {}, report);
  ASSERT_EQ(report.problems().size(), 1U);
  EXPECT_EQ(report.problems()[0].position, (Point3d{95.0, 8.0, 3.0}));
  EXPECT_FALSE(report.problems()[0].lon_lat_deg) << "there is no latitude of 95 degrees";
}

}  // namespace
}  // namespace farlod::georeference
