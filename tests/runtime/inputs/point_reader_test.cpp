// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/point_reader.hpp"

#include <gmock/gmock.h>

#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RequestedPoints table_of(const std::string& text) {
  const scenes::TemporaryFolder folder;
  std::ofstream(folder.file("points.csv"), std::ios::binary) << text;
  return read_points_csv(folder.file("points.csv"));
}

std::vector<RequestedPoint> points_in(const std::string& text) { return table_of(text).points; }

/// The attributes of a point.
std::vector<std::string> row_of(const Attributes& attributes, std::size_t row) {
  std::vector<std::string> values;
  for (std::size_t column = 0; column < attributes.names().size(); ++column) values.emplace_back(attributes.value(row, column));
  return values;
}

std::string complaint_about(const std::string& text) {
  return scenes::refusal_of<PointsError>([&] { (void)points_in(text); });
}

void expect_the_two_points(const std::vector<RequestedPoint>& points) {
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].x, 1.5);
  EXPECT_EQ(points[0].y, -2.0);
  EXPECT_EQ(points[0].z, 3.0);
  EXPECT_EQ(points[1].x, 4.0);
  EXPECT_EQ(points[1].y, 5.0);
  EXPECT_EQ(points[1].z, std::nullopt);
}

TEST(PointReader, EverySeparatorAndLineEndGivesTheSame) {
  expect_the_two_points(points_in("id,x,y,z\na,1.5,-2,3\nb,4,5,\n"));
  expect_the_two_points(points_in("id;x;y;z\r\na;1.5;-2;3\r\nb;4;5;\r\n"));
  expect_the_two_points(points_in("id\tx\ty\tz\na\t1.5\t-2\t3\nb\t4\t5\t"));
  expect_the_two_points(points_in("\xEF\xBB\xBF\"id\", \"x\", \"y\", \"z\"\n\n\"a\", \"1.5\", -2, 3\n , , , \nb, +4.0, 5e0\n"));
}

TEST(PointReader, FindsColumnsByAnyOfTheirNames) {
  for (const char* header : {"y,x,z,id", "Northing,EASTING,Elevation,Name", "lat,lon,height_m,fid", "latitude,longitude,z_m,ID",
                             "y_m,x_m,Z,id", "Lat,LNG,z,id"}) {
    const std::vector<RequestedPoint> points = points_in(std::string(header) + "\n-2,1.5,3,a\n5,4,,b\n");
    expect_the_two_points(points);
    EXPECT_EQ(points[0].id, "a");
    EXPECT_EQ(points[1].id, "b");
  }
}

TEST(PointReader, OtherColumnsAreAttributes) {
  const RequestedPoints table = table_of("note,x,,ID,speed,y,z,name\n\"a,b\",1.5,,i,9,-2,3,N\n,4,7,j,9,5,,\n");
  expect_the_two_points(table.points);
  EXPECT_THAT(table.attributes.names(), ElementsAre("note", "column_3", "speed", "name"));
  EXPECT_THAT(row_of(table.attributes, 0), ElementsAre("a,b", "", "9", "N"));
  EXPECT_THAT(row_of(table.attributes, 1), ElementsAre("", "7", "9", ""));
  EXPECT_EQ(table.points[1].id, "j");
}

TEST(PointReader, AnIdOfAnotherNameIsAnAttributeToo) {
  const RequestedPoints table = table_of("name,x,y\nNorth,1,2\n");
  EXPECT_EQ(table.points[0].id, "North");
  EXPECT_THAT(table.attributes.names(), ElementsAre("name"));
}

TEST(PointReader, AFieldWithoutAColumnIsNamed) {
  EXPECT_THAT(complaint_about("x,y,note\n1,2,a\n3,4,b,c\n"), HasSubstr("points.csv:3: \"c\" has no column"));
  EXPECT_EQ(points_in("x,y,note\n1,2,a,,\n").size(), 1U);
}

TEST(PointReader, AzimuthAndTiltAreANormal) {
  const RequestedPoints table = table_of("x,y,Azimuth,tilt_deg\n1,2,-90,45\n1,2,,\n1,2,,0\n");
  EXPECT_TRUE(table.has_normals);
  EXPECT_THAT(table.attributes.names(), IsEmpty());
  ASSERT_TRUE(table.points[0].normal);
  EXPECT_EQ(table.points[0].normal->azimuth_deg, -90.0);
  EXPECT_EQ(table.points[0].normal->tilt_deg, 45.0);
  EXPECT_FALSE(table.points[1].normal);
  EXPECT_EQ(table.points[2].normal->tilt_deg, 0.0);
}

TEST(PointReader, TheRowsOfARefusedTableAreCounted) {
  EXPECT_THAT(complaint_about("lon,lat\n1,1\nfoo,2\nbar,3\n"),
              AllOf(HasSubstr("points.csv:3: \"foo\" is not a number (lon)"),
                    HasSubstr("cannot be read: 2 of 3 (lines 3, 4); mend them, or leave them out")));
}

TEST(PointReader, DegreesComeBackBesideTheMetresOfAnswers) {
  EXPECT_THAT(table_of("Station,lon,lat,note\na,4.4,51.9,b\n").attributes.names(), ElementsAre("Station", "lon", "lat", "note"));
  EXPECT_EQ(points_in("Station,lon,lat\na,4.4,51.9\n")[0].id, "a");
}

TEST(PointReader, HalfANormalIsRefusedInARow) {
  EXPECT_THAT(complaint_about("x,y,azimuth,tilt\n1,2,90,\n"), HasSubstr("points.csv:2: there is an azimuth and no tilt"));
  EXPECT_THAT(complaint_about("x,y,azimuth,tilt\n1,2,,9\n"), HasSubstr("points.csv:2: there is a tilt and no azimuth"));
  EXPECT_THAT(complaint_about("x,y,azimuth,tilt\n1,2,0,181\n"), HasSubstr("points.csv:2: the tilt is not between"));
  EXPECT_THAT(complaint_about("x,y,azimuth,tilt\n1,2,361,9\n"), HasSubstr("points.csv:2: the azimuth is not between"));
  EXPECT_THAT(complaint_about("x,y,azimuth,tilt\n1,2,north,9\n"), HasSubstr("\"north\" is not a number (azimuth)"));
}

TEST(PointReader, HalfANormalIsAnAttributeInAHeader) {
  const RequestedPoints table = table_of("x,y,azimuth\n1,2,north\n");
  EXPECT_FALSE(table.has_normals);
  EXPECT_THAT(table.attributes.names(), ElementsAre("azimuth"));
}

TEST(PointReader, WithoutHeaderTheColumnsAreXYZ) {
  const std::vector<RequestedPoint> points = points_in("1.5,-2,3\n4,5\n");
  expect_the_two_points(points);
  EXPECT_EQ(points[0].id, "1");
  EXPECT_EQ(points[1].id, "2");
}

TEST(PointReader, ABadNumberIsNamedWithItsLine) {
  EXPECT_THAT(complaint_about("x,y\n1,2\n\n3,4m\n"), AllOf(HasSubstr("points.csv:4: "), HasSubstr("\"4m\" is not a number (y)")));
  EXPECT_THAT(complaint_about("id,x,y\n\"two\nlines\",1,2\nb,,4\n"),
              AllOf(HasSubstr("points.csv:4: "), HasSubstr("x is empty; write a number")));
  EXPECT_THAT(complaint_about("x,y\nnan,2\n"), HasSubstr("points.csv:2: "));
  EXPECT_THAT(complaint_about("x,y\n1,1e999\n"), HasSubstr("points.csv:2: "));
  EXPECT_THAT(complaint_about("x;y\n1,5;2\n"), HasSubstr("write it like 1234.5"));
}

TEST(PointReader, ARowOfManyThatCannotBeReadKeepsItsPlaceInTheTableAndIsTold) {
  std::string stations = "x,y,street\n";
  for (int n = 1; n <= 20; ++n) stations += (n == 7 ? "unknown" : std::to_string(n)) + ",5,s" + std::to_string(n) + "\n";
  const RequestedPoints read = table_of(stations);
  ASSERT_EQ(read.points.size(), 20U);
  EXPECT_FALSE(read.points[6].has_place());
  EXPECT_EQ(read.points[6].id, "7");
  EXPECT_THAT(row_of(read.attributes, 6), ElementsAre("s7"));
  EXPECT_EQ(read.skipped_features, 1U);
  EXPECT_THAT(read.notes, ElementsAre(AllOf(HasSubstr("points.csv:8"), HasSubstr("\"unknown\""),
                                            HasSubstr("1 of 20 rows cannot be read and has"))));
  EXPECT_EQ(read.points[7].id, "8");
  EXPECT_THAT(row_of(read.attributes, 7), ElementsAre("s8"));
  EXPECT_THAT(table_of(stations + "u,5,\nv,5,\n" + stations.substr(stations.find('\n') + 1)).notes,
              ElementsAre(HasSubstr("4 of 42 rows cannot be read and have no answer (lines 8, 22, 23, 30).")));
  // One row in five is no accident
  EXPECT_THAT(complaint_about("x,y\n1,1\n2,2\nunknown,3\n4,4\n5,5\n"), HasSubstr("points.csv:4"));
}

TEST(PointReader, HeightsAboveTheGroundHaveAColumnOfTheirOwn) {
  for (const char* name : {"height_above_ground_m", "Height_Above_Ground"}) {
    const RequestedPoints table = table_of(std::string("x,y,") + name + "\n1,2,3.5\n4,5,\n");
    EXPECT_EQ(table.points[0].above_ground_m, 3.5);
    EXPECT_FALSE(table.points[0].z);
    EXPECT_FALSE(table.points[1].above_ground_m);
    EXPECT_THAT(table.attributes.names(), IsEmpty());
  }
  EXPECT_THAT(complaint_about("x,y,height_above_ground\n1,2,-3\n"), HasSubstr("is not between 0 and 10,000 m"));
  // Answers that are read again say both
  const RequestedPoints both = table_of("x,y,z_m,height_above_ground_m\n1,2,30,3.5\n");
  EXPECT_EQ(both.points[0].z, 30.0);
  EXPECT_FALSE(both.points[0].above_ground_m);
  EXPECT_THAT(both.attributes.names(), ElementsAre("height_above_ground_m"));
}

TEST(PointReader, HeightsThatMayCountFromElsewhereAreTold) {
  EXPECT_EQ(table_of("x,y,Height_M\n1,2,3\n").doubtful_z, "Height_M");
  EXPECT_EQ(table_of("x,y,z\n1,2,3\n").doubtful_z, "");
  EXPECT_THAT(table_of("x,y,height\n1,2,3\n").notes,
              ElementsAre(AllOf(HasSubstr("\"height\" places no point"), HasSubstr("height_above_ground_m"))));
  EXPECT_THAT(table_of("x,y,z,height\n1,2,3,4\n").notes, IsEmpty());
}

TEST(PointReader, ColumnsOfDegreesMayHoldRowsInWhichTheyAreExchanged) {
  EXPECT_EQ(table_of("lon,lat\n139.6,35.9\n35.9,139.6\n139.6,35.9\n").crs_wkt, "OGC:CRS84");
  EXPECT_EQ(table_of("lon,lat\n500000,5500000\n9,49\n").crs_wkt, std::nullopt);
}

TEST(PointReader, AShortRowIsNamed) {
  EXPECT_THAT(complaint_about("x,y\n1\n"), HasSubstr("points.csv:2: the row ends before y"));
}

TEST(PointReader, UnknownOrAmbiguousColumnsAreRefused) {
  EXPECT_THAT(complaint_about("a,b\n1,2\n"), AllOf(HasSubstr("points.csv:1: no column is named x and y"),
                                                   HasSubstr("lon and lat), of \"a\", \"b\"; name them")));
  std::string wide = "c";
  for (int n = 0; n < 30; ++n) wide += ",c";
  EXPECT_THAT(complaint_about(wide + "\n1\n"), HasSubstr("\"c\" and 11 more; name them"));
  EXPECT_THAT(complaint_about("x,y,lon,lat\n1,2,3,4\n"), HasSubstr("\"x\" and \"lon\" mean the same"));
  EXPECT_THAT(complaint_about("1,2,3,4\n"), HasSubstr("points.csv:1: a table without a header row"));
}

TEST(PointReader, NothingToReadIsRefused) {
  EXPECT_THAT(complaint_about(""), HasSubstr("holds no points"));
  EXPECT_THAT(complaint_about("x,y\n"), HasSubstr("a header row but no points"));
  EXPECT_THROW((void)read_points_csv("/no such folder/points.csv"), PointsError);
}

TEST(PointReader, ATableOfAnyContentIsReadWhole) {
  const scenes::TemporaryFolder folder;
  std::ofstream(folder.file("a.csv")) << "building;kind\r\n\"a; b\";roof\r\nc;\r\n";
  EXPECT_THAT(read_header_csv(folder.file("a.csv")), ElementsAre("building", "kind"));
  const Attributes table = read_table_csv(folder.file("a.csv"));
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_EQ(table.value(0, 0), "a; b");
  EXPECT_EQ(table.value(1, 1), "");
  std::ofstream(folder.file("b.csv")) << "1,2\n3,4\n";
  EXPECT_TRUE(read_header_csv(folder.file("b.csv")).empty());
  EXPECT_THROW((void)read_table_csv(folder.file("b.csv")), PointsError);
}

TEST(PointReader, AFolderIsRefused) { EXPECT_THROW((void)read_points_csv(scenes::TemporaryFolder().path()), PointsError); }

}  // namespace
}  // namespace farlod
