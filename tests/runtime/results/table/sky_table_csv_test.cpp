// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_table_csv.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inputs/point_reader.hpp"
#include "results/table/csv_text.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

std::string csv_field(std::string_view text) {
  CsvText csv;
  csv.field(text);
  return csv.bytes();
}

PointRows point_rows(const std::vector<PointRow>& rows) {
  return {rows.size(), [&rows](std::size_t n) { return rows[n]; }, nullptr, false};
}

void write_surface_points(const std::vector<SurfacePoint>& rows, const AnswerColumns& columns,
                          const std::filesystem::path& path) {
  SurfacePointsCsv table(columns, path);
  table.write_part(0, rows);
  table.commit();
}

TEST(CsvField, IsQuotedWhereItMustBe) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("the \"old\" town"), "\"the \"\"old\"\" town\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

TEST(CsvText, SeparatesFieldsAndEndsRows) {
  CsvText csv;
  csv.field("").whole(7).millimetres(std::nullopt).end_row();
  csv.svf(std::nullopt).svf(0.5).millimetres(1.25).end_row();
  EXPECT_EQ(csv.bytes(), ",7,\n,0.500000,1.25\n");
}

TEST(PointsCsv, IsAsDocumented) {
  const scenes::TemporaryFolder folder;
  const std::vector<PointRow> rows{{"square, north", {500000.12345, 5700010.0}, 1.5, 0.5, 0.25, 0.75},
                                   {"inside", {1.0, -2.25}, {}, {}, {}, {}}};
  write_points_csv(point_rows(rows), {"svf_solid", BoundsColumns::no}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "id,x_m,y_m,z_m,svf_solid\n"
            "\"square, north\",500000.123,5700010,1.5,0.500000\n"
            "inside,1,-2.25,,\n");
  write_points_csv(point_rows(rows), {"svf", BoundsColumns::yes}, folder.file("b.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("b.csv")),
            "id,x_m,y_m,z_m,svf,svf_low,svf_high\n"
            "\"square, north\",500000.123,5700010,1.5,0.500000,0.250000,0.750000\n"
            "inside,1,-2.25,,,,\n");
}

TEST(PointsCsv, HasAttributesBehindTheIdAndNormalsBeforeTheAnswer) {
  const scenes::TemporaryFolder folder;
  Attributes attributes({"note", "count"});
  attributes.add_row(std::vector<std::string>{"a,b", "3"});
  attributes.add_row(std::vector<std::string>{"", "4"});
  const std::vector<PointRow> rows{{"1", {1.0, 2.0}, 3.0, 0.5, {}, {}, 270.0, 45.5}, {"2", {3.0, 4.0}, {}, {}, {}, {}, {}, {}}};
  PointRows with_attributes = point_rows(rows);
  with_attributes.attributes = &attributes;
  with_attributes.normals = true;
  write_points_csv(with_attributes, {"svf", BoundsColumns::no}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "id,note,count,x_m,y_m,z_m,azimuth_deg,tilt_deg,svf\n"
            "1,\"a,b\",3,1,2,3,270,45.5,0.500000\n"
            "2,,4,3,4,,,,\n");
}

TEST(PointsCsv, FurtherColumnsFollowTheBounds) {
  const scenes::TemporaryFolder folder;
  const std::vector<float> of_first{12.25F, std::nanf("")}, of_second{1e-7F, 300.0F};
  const std::vector<PointRow> rows{{"1", {1.0, 2.0}, 3.0, 0.5, 0.25, 0.75, {}, {}, of_first},
                                   {"2", {3.0, 4.0}, {}, {}, {}, {}, {}, {}, of_second}};
  const AnswerColumns columns{"svf", BoundsColumns::yes, {{"sun_h"}, {"sky_w_m2"}}};
  write_points_csv(point_rows(rows), columns, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "id,x_m,y_m,z_m,svf,svf_low,svf_high,sun_h,sky_w_m2\n"
            "1,1,2,3,0.500000,0.250000,0.750000,12.25,\n"
            "2,3,4,,,,,0.0000001,300\n");
  EXPECT_EQ(own_columns_of_points(false, columns).back(), "sky_w_m2");
}

TEST(PointsCsv, CanBeReadAsPointsAgain) {
  const scenes::TemporaryFolder folder;
  const std::vector<PointRow> rows{{"the \"first\", quoted\nover two lines", {500000.125, 5700010.25}, 1.5, 0.5, {}, {}},
                                   {"2nd", {1.0, -2.25}, {}, {}, {}, {}}};
  write_points_csv(point_rows(rows), {"svf", BoundsColumns::no}, folder.file("a.csv"));
  const std::vector<RequestedPoint> points = read_points_csv(folder.file("a.csv")).points;
  ASSERT_EQ(points.size(), rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    EXPECT_EQ(points[n].id, rows[n].id);
    EXPECT_EQ((Point2d{points[n].x, points[n].y}), rows[n].p_projected);
    EXPECT_EQ(points[n].z, rows[n].height_m);
  }
}

TEST(SurfacePointsCsv, IsAsDocumented) {
  const scenes::TemporaryFolder folder;
  const std::vector<SurfacePoint> rows{
      {"b1", 7, SurfaceKind::wall, {10.0, 20.0, 3.125}, Angle::degrees(181.25), Angle::degrees(90.0), 4.0, 0.25, 0.125, 0.5}};
  write_surface_points(rows, {"svf", BoundsColumns::no}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "building,surface,kind,x_m,y_m,z_m,azimuth_deg,tilt_deg,area_m2,svf\n"
            "b1,7,wall,10,20,3.125,181.25,90,4,0.250000\n");
  write_surface_points(rows, {"svf", BoundsColumns::yes}, folder.file("b.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("b.csv")),
            "building,surface,kind,x_m,y_m,z_m,azimuth_deg,tilt_deg,area_m2,svf,svf_low,svf_high\n"
            "b1,7,wall,10,20,3.125,181.25,90,4,0.250000,0.125000,0.500000\n");
}

TEST(SurfacePointsCsv, PartsStandInOrderHoweverTheyCome) {
  const scenes::TemporaryFolder folder;
  std::vector<SurfacePoint> rows(5);
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n].surface = static_cast<std::uint32_t>(n);
  const std::span<const SurfacePoint> all(rows);
  {
    SurfacePointsCsv table({"svf", BoundsColumns::no}, folder.file("a.csv"));
    table.write_part(70, all.subspan(4));
    table.write_part(5, all.subspan(0, 2));
    table.write_part(9, {});
    table.write_part(12, all.subspan(2, 2));
    table.commit();
  }
  write_surface_points(rows, {"svf", BoundsColumns::no}, folder.file("b.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")), scenes::text_of(folder.file("b.csv")));
  EXPECT_EQ(folder.names().size(), 2U);
}

TEST(SurfacePointsCsv, FurtherColumnsFollowRowByRow) {
  const scenes::TemporaryFolder folder;
  std::vector<SurfacePoint> rows(2);
  SurfacePointsCsv table({"svf", BoundsColumns::no, {{"a"}, {"b"}}}, folder.file("a.csv"));
  rows[0].further = {1.5F, std::nanf("")};
  table.write_part(0, rows);
  table.commit();
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "building,surface,kind,x_m,y_m,z_m,azimuth_deg,tilt_deg,area_m2,svf,a,b\n"
            ",0,unknown,0,0,0,0,0,0,,1.5,\n"
            ",0,unknown,0,0,0,0,0,0,,,\n");
}

TEST(SurfacesCsv, IsAsDocumented) {
  const scenes::TemporaryFolder folder;
  std::vector<SurfaceMean> rows(2);
  rows[0] = {"b1", 0, SurfaceKind::roof, Angle::degrees(0.0), Angle::degrees(0.0), 100.5, 4.5, 25, 1, 0.75, 0.5, 1.0, {0.25}};
  rows[1].building = "b2";
  write_surfaces_csv(rows, {"svf", BoundsColumns::no, {{"svfN"}}}, folder.file("a.csv"));
  EXPECT_EQ(
      scenes::text_of(folder.file("a.csv")),
      "building,surface,kind,azimuth_deg,tilt_deg,area_m2,receivers,nodata,svf_mean,svf_min,svf_max,covered_area_m2,svfN_mean\n"
      "b1,0,roof,0,0,100.5,25,1,0.750000,0.500000,1.000000,4.5,0.25\n"
      "b2,0,unknown,0,0,0,0,0,,,,0,\n");
}

TEST(SurfaceTablesCsv, AreThreeFilesThatAppearTogether) {
  const scenes::TemporaryFolder folder;
  const std::vector<SurfacePoint> rows(1);
  SurfaceTablesCsv tables({"svf", BoundsColumns::yes}, folder.file("a.b.csv"));
  tables.write_part(3, rows);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.b.csv")));
  const std::vector<std::filesystem::path> files = tables.commit({}, {});
  const std::vector<std::filesystem::path> expected{folder.file("a.b.csv"), folder.file("a.b.surfaces.csv"),
                                                    folder.file("a.b.buildings.csv")};
  EXPECT_EQ(files, expected);
  for (const auto& file : expected) EXPECT_NE(scenes::text_of(file), "") << file;
}

TEST(BuildingsCsv, IsAsDocumented) {
  const scenes::TemporaryFolder folder;
  const std::vector<BuildingMean> rows{{"b1", 100.0, 0.0, 2.5, 0.0, 25, 0, 0.75, std::nullopt}};
  write_buildings_csv(rows, {"svf"}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "building,roof_area_m2,wall_area_m2,receivers,nodata,svf_roofs,svf_walls,covered_roof_area_m2,covered_wall_area_m2\n"
            "b1,100,0,25,0,0.750000,,2.5,0\n");
}

}  // namespace
}  // namespace farlod
