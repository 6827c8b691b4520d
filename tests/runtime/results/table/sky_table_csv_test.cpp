// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_table_csv.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "inputs/point_reader.hpp"
#include "results/picture/picture.hpp"
#include "results/table/sky_features.hpp"
#include "results/table/sky_table_ply.hpp"
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
  const std::vector<PointRow> rows{{"square, north", {500000.12345, 5700010.0}, 1.5, 0.5, 0.25, 0.75, {}, {}, {}, 1.25},
                                   {"inside", {1.0, -2.25}, {}, {}, {}, {}}};
  write_points_csv(point_rows(rows), {"svf_solid", BoundsColumns::no}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "id,x_m,y_m,z_m,height_above_ground_m,svf_solid\n"
            "\"square, north\",500000.123,5700010,1.5,1.25,0.500000\n"
            "inside,1,-2.25,,,\n");
  write_points_csv(point_rows(rows), {"svf", BoundsColumns::yes}, folder.file("b.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("b.csv")),
            "id,x_m,y_m,z_m,height_above_ground_m,svf,svf_low,svf_high\n"
            "\"square, north\",500000.123,5700010,1.5,1.25,0.500000,0.250000,0.750000\n"
            "inside,1,-2.25,,,,,\n");
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
            "id,note,count,x_m,y_m,z_m,height_above_ground_m,azimuth_deg,tilt_deg,svf\n"
            "1,\"a,b\",3,1,2,3,,270,45.5,0.500000\n"
            "2,,4,3,4,,,,,\n");
}

TEST(PointsCsv, FurtherColumnsFollowTheBounds) {
  const scenes::TemporaryFolder folder;
  const std::vector<float> of_first{12.25F, std::nanf("")}, of_second{1e-7F, 300.0F};
  const std::vector<PointRow> rows{{"1", {1.0, 2.0}, 3.0, 0.5, 0.25, 0.75, {}, {}, of_first},
                                   {"2", {3.0, 4.0}, {}, {}, {}, {}, {}, {}, of_second}};
  const AnswerColumns columns{"svf", BoundsColumns::yes, {{"sun_h"}, {"sky_w_m2"}}};
  write_points_csv(point_rows(rows), columns, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "id,x_m,y_m,z_m,height_above_ground_m,svf,svf_low,svf_high,sun_h,sky_w_m2\n"
            "1,1,2,3,,0.500000,0.250000,0.750000,12.25,\n"
            "2,3,4,,,,,,0.0000001,300\n");
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
  const std::vector<BuildingMean> rows{{"b1", 100.0, 0.0, 2.5, 0.0, 25, 0, 0.75}, {"b2", 0.0, 0.0, 0.0, 7.0, 3, 3}};
  write_buildings_csv(rows, {"svf"}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "building,roof_area_m2,wall_area_m2,receivers,nodata,svf_roofs,svf_walls,covered_roof_area_m2,covered_wall_area_m2\n"
            "b1,100,,25,0,0.750000,,2.5,\n"
            "b2,,0,3,3,,,,7\n");
}

/// Of a run that asked for irradiation, and for the area that gets some of it.
const AnswerColumns irradiated{"svf", BoundsColumns::no, {{"irradiation"}, {"shade"}}, ThresholdColumns::yes};

TEST(SurfacesCsv, HaveTheSumOfIrradiation) {
  const scenes::TemporaryFolder folder;
  std::vector<SurfaceMean> rows(2);
  rows[0] = {
      "b1", 0, SurfaceKind::roof, {}, {}, 100.5, 4.5, 25, 1, 0.75, 0.5, 1.0, {1000.25, 0.5}, AreaIrradiation{100525.125, 90.0}};
  rows[1].building = "b2";
  write_surfaces_csv(rows, irradiated, folder.file("a.csv"));
  const std::string text = scenes::text_of(folder.file("a.csv"));
  EXPECT_THAT(text, testing::HasSubstr(",covered_area_m2,irradiation_mean,shade_mean,irradiation_kwh,area_above_m2\n"));
  EXPECT_THAT(text, testing::HasSubstr(",4.5,1000.25,0.5,100525.125,90\n"));
  EXPECT_TRUE(text.ends_with("\nb2,0,unknown,0,0,0,0,0,,,,0,,,,\n")) << text;
}

TEST(BuildingsCsv, HaveFurtherColumnsOfRoofsAndWalls) {
  const scenes::TemporaryFolder folder;
  std::vector<BuildingMean> rows{{"b1", 100.0, 50.0, 0.0, 0.0, 25, 0, 0.75, 0.5}, {"b2", 0.0, 0.0, 9.0, 0.0, 1, 1}};
  rows[0].further_roofs = {1000.25, 0.5};
  rows[0].further_walls = {500.5, 0.25};
  rows[0].roof_irradiation = {100025.0, 90.5};
  rows[0].wall_irradiation = {25025.0, 0.0};
  write_buildings_csv(rows, irradiated, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "building,roof_area_m2,wall_area_m2,receivers,nodata,svf_roofs,svf_walls,covered_roof_area_m2,covered_wall_area_m2,"
            "irradiation_roofs,shade_roofs,irradiation_walls,shade_walls,roof_irradiation_kwh,wall_irradiation_kwh,"
            "roof_area_above_m2,wall_area_above_m2\n"
            "b1,100,50,25,0,0.750000,0.500000,0,0,1000.25,0.5,500.5,0.25,100025,25025,90.5,0\n"
            "b2,0,,1,1,,,9,,,,,,,,,\n");
}

/// A PLY file, read by its own header.
struct Ply {
  std::vector<std::string> names, types;
  std::vector<std::string> comments;
  std::vector<std::vector<double>> vertices;

  explicit Ply(const std::string& bytes) {
    const std::string end = "end_header\n";
    const std::size_t data = bytes.find(end) + end.size();
    std::istringstream header(bytes.substr(0, data));
    std::size_t count = 0;
    for (std::string line; std::getline(header, line);) take(line, count);
    std::size_t place = data;
    for (std::size_t n = 0; n < count; ++n) {
      vertices.emplace_back();
      for (const std::string& type : types) vertices.back().push_back(value(bytes, place, type));
    }
    EXPECT_EQ(place, bytes.size());
  }
  [[nodiscard]] double at(std::size_t vertex, const std::string& name) const {
    for (std::size_t n = 0; n < names.size(); ++n)
      if (names[n] == name) return vertices.at(vertex)[n];
    ADD_FAILURE() << "no property " << name;
    return 0.0;
  }

 private:
  void take(const std::string& line, std::size_t& count) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type >> name;
    if (word == "comment") comments.push_back(line.substr(8));
    if (word == "element") count = std::stoul(name);
    if (word != "property") return;
    types.push_back(type);
    names.push_back(name);
  }
  static double value(const std::string& bytes, std::size_t& place, const std::string& type) {
    const auto read = [&]<class Number>(Number number) {
      std::memcpy(&number, bytes.data() + place, sizeof(number));
      place += sizeof(number);
      return static_cast<double>(number);
    };
    return type == "double" ? read(0.0) : type == "float" ? read(0.0F) : read(static_cast<unsigned char>(0));
  }
};

constexpr double rounding_of_float = 1e-7;  // of numbers up to 1

TEST(Ply, HasPlacesNormalsAnswersAndColours) {
  const scenes::TemporaryFolder folder;
  const std::vector<float> further{12.5F};
  const std::vector<PointRow> rows{{"a", {500000.125, 5700010.5}, 7.25, 0.5, 0.25, 0.75, 92.0, 90.0, further},
                                   {"in a house", {1.0, 2.0}, {}, {}, {}, {}, {}, {}, further},
                                   {"no answer", {3.0, 4.0}, 5.0, {}, {}, {}, {}, {}, further}};
  TableFrame frame{{"svf", BoundsColumns::yes, {{"sun_h"}}}};
  frame.epsg = 25832;
  frame.convergence = Angle::degrees(2.0);
  frame.provenance = {"Far-LoD", "two\nlines", "", ""};
  write_points_ply({rows.size(), [&](std::size_t n) { return rows[n]; }, nullptr, true}, frame, folder.file("a.ply"));
  const Ply ply(scenes::text_of(folder.file("a.ply")));
  EXPECT_THAT(ply.comments, testing::ElementsAre("software: Far-LoD", "package: two lines", "crs: EPSG:25832"));
  EXPECT_THAT(ply.names, testing::ElementsAre("x", "y", "z", "nx", "ny", "nz", "svf", "svf_low", "svf_high", "sun_h", "red",
                                              "green", "blue"));
  ASSERT_EQ(ply.vertices.size(), 2U);
  EXPECT_EQ(ply.at(0, "x"), 500000.125);
  EXPECT_EQ(ply.at(0, "y"), 5700010.5);
  EXPECT_EQ(ply.at(0, "z"), 7.25);
  // 92° from true north is 90° from the north of the grid
  EXPECT_NEAR(ply.at(0, "nx"), 1.0, rounding_of_float);
  EXPECT_NEAR(ply.at(0, "ny"), 0.0, rounding_of_float);
  EXPECT_NEAR(ply.at(0, "nz"), 0.0, rounding_of_float);
  EXPECT_EQ(ply.at(0, "svf_high"), 0.75);
  EXPECT_EQ(ply.at(0, "sun_h"), 12.5);
  EXPECT_EQ(ply.at(0, "green"), colour_of_svf(0.5).green);
  EXPECT_TRUE(std::isnan(ply.at(1, "svf")));
  EXPECT_EQ(ply.at(1, "nz"), 1.0);
  EXPECT_EQ(ply.at(1, "blue"), nodata_colour.blue);
}

TEST(Ply, HasTheReceiversOfSurfacesInOrder) {
  const scenes::TemporaryFolder folder;
  SurfaceSpool spool(folder.file("a.ply"));
  std::vector<SurfacePoint> rows(3);
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n].p_projected.x = static_cast<double>(n);
  spool.add(2, std::span(rows).subspan(1));
  spool.add(1, std::span(rows).first(1));
  write_receivers_ply(spool, {{"svf_solid"}}, folder.file("a.ply"));
  const Ply ply(scenes::text_of(folder.file("a.ply")));
  ASSERT_EQ(ply.vertices.size(), 3U);
  for (std::size_t n = 0; n < rows.size(); ++n) EXPECT_EQ(ply.at(n, "x"), static_cast<double>(n));
  EXPECT_EQ(ply.names[6], "svf_solid");
}

FieldType type_of_values(const std::vector<std::string>& values) {
  Attributes attributes({"a"});
  for (const std::string& value : values) attributes.add_row(std::vector<std::string>{value});
  return type_of_column(attributes, 0, values.size());
}

TEST(TypeOfColumn, IsOfNumbersWhereAllValuesAre) {
  EXPECT_EQ(type_of_values({"1", "-20", "", "9007199254740993"}), FieldType::whole);
  EXPECT_EQ(type_of_values({"1", "0.25", "1e-3", ""}), FieldType::real);
  EXPECT_EQ(type_of_values({"1", "0.25", "east"}), FieldType::text);
  EXPECT_EQ(type_of_values({"", ""}), FieldType::text);
}

TEST(TypeOfColumn, IsTextWhereANumberWouldNotComeBackAsItWas) {
  for (const char* text :
       {"007", "-01.5", "+1", "1,5", "0x10", "1 ", "inf", "nan", "3.14159265358979323846264338", "12.3.4", "-"})
    EXPECT_EQ(type_of_values({"1", text}), FieldType::text) << text;
  EXPECT_EQ(type_of_values({"0", "0.5", "-0.5"}), FieldType::real);
  // More than 64 bits
  EXPECT_EQ(type_of_values({"92233720368547758080"}), FieldType::real);
}

std::vector<SurfacePoint> rows_numbered(std::uint32_t first, std::size_t count) {
  std::vector<SurfacePoint> rows(count);
  for (std::size_t n = 0; n < count; ++n) {
    rows[n].building = std::string(n, 'b');
    rows[n].surface = first + static_cast<std::uint32_t>(n);
    rows[n].kind = SurfaceKind::roof;
    rows[n].p_projected = {1.25, 2.5, 3.75};
    rows[n].azimuth = Angle::degrees(90.0);
    rows[n].tilt = Angle::degrees(30.0);
    rows[n].area_m2 = 7.5;
    if (n % 2 == 0) rows[n].svf = 0.5;
    if (n % 2 == 1) rows[n].high = 0.75;
  }
  return rows;
}

TEST(SurfaceSpool, GivesRowsBackInTheOrderOfTheirParts) {
  const scenes::TemporaryFolder folder;
  SurfaceSpool spool(folder.file("a.gpkg"));
  std::vector<SurfacePoint> last = rows_numbered(100, 2);
  last[0].further = {0.5F, 1.5F};
  spool.add(9, last);
  spool.add(3, rows_numbered(50, 3));
  spool.add(5, {});
  EXPECT_EQ(spool.size(), 5U);
  std::vector<SurfacePoint> rows;
  spool.for_each([&](const SurfacePoint& row) { rows.push_back(row); });
  std::vector<SurfacePoint> expected = rows_numbered(50, 3);
  for (const SurfacePoint& row : last) expected.push_back(row);
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    EXPECT_EQ(rows[n].building, expected[n].building);
    EXPECT_EQ(rows[n].surface, expected[n].surface);
    EXPECT_EQ(rows[n].kind, expected[n].kind);
    EXPECT_EQ(rows[n].p_projected, expected[n].p_projected);
    EXPECT_EQ(rows[n].azimuth.degrees(), expected[n].azimuth.degrees());
    EXPECT_EQ(rows[n].tilt.degrees(), expected[n].tilt.degrees());
    EXPECT_EQ(rows[n].area_m2, expected[n].area_m2);
    EXPECT_EQ(rows[n].svf, expected[n].svf);
    EXPECT_EQ(rows[n].further, expected[n].further);
    EXPECT_EQ(rows[n].low, expected[n].low);
    EXPECT_EQ(rows[n].high, expected[n].high);
  }
}

TEST(VerificationCsv, HasPlacesValuesAndExactValues) {
  const scenes::TemporaryFolder folder;
  const std::vector<VerifiedReceiver> receivers{{{691000.25, 5335000.0, 512.5}, 0.75F, 0.5F}, {{1.0, 2.0, -3.0}, 0.0F, 1.0F}};
  write_verification_csv(receivers, "svf_solid", folder.path() / "v.csv");
  std::stringstream text;
  text << std::ifstream(folder.path() / "v.csv").rdbuf();
  EXPECT_EQ(text.str(),
            "x_m,y_m,z_m,svf_solid,svf_solid_exact\n"
            "691000.25,5335000,512.5,0.750000,0.500000\n1,2,-3,0.000000,1.000000\n");
}

}  // namespace
}  // namespace farlod
