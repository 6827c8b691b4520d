// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

std::string triangle(const std::string& z) { return within("gml:Triangle gml:exterior", ring(z)); }
std::string tin(const std::string& content) {
  return within("cityObjectMember dem:ReliefFeature dem:reliefComponent dem:TINRelief dem:tin", content);
}
const std::vector<Point3d> corners_at_5{{0, 0, 5}, {9, 0, 5}, {9, 9, 5}};

TEST(CityGmlRelief, ATerrainAloneIsACityWithoutBuildings) {
  const std::string text = tin(within("gml:TriangulatedSurface gml:trianglePatches", triangle("5")));
  for (const std::string& file : {model(text), model_3(text)}) {
    const Reading r = read_citygml_text(file);
    EXPECT_TRUE(r.city().buildings().empty());
    EXPECT_EQ(r.source.relief_points, corners_at_5) << "without the point that closes the ring";
    EXPECT_TRUE(r.source.skipped.empty());
    EXPECT_TRUE(r.codes().empty());
  }
}

TEST(CityGmlRelief, TrianglesBelongToNoBuilding) {
  const std::string text = tin(within("gml:TriangulatedSurface gml:trianglePatches", triangle("5")));
  const Reading r = read_citygml_text(model(text + building(surface("bldg:lod1MultiSurface", "a", "1")) + text));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_EQ(r.source.relief_points.size(), 6u);
}

TEST(CityGmlRelief, ATinIsGivenByItsControlPointsToo) {
  const std::string text =
      tin("<gml:Tin><gml:boundedBy><gml:Envelope><gml:pos>77 77 77</gml:pos></gml:Envelope></gml:boundedBy>" +
          within("gml:trianglePatches", "") + within("gml:maxLength", "10") +
          within("gml:controlPoint gml:posList", "0 0 5 9 0 5\n 9 9 5") + "</gml:Tin>");
  EXPECT_EQ(read_citygml_text(model(text)).source.relief_points, corners_at_5);
}

TEST(CityGmlRelief, MassPointsAreRead) {
  std::string points;
  for (const char* position : {"0 0 5", "9 0 5", "9 9 5"}) points += within("gml:pointMember gml:Point gml:pos", position);
  const std::string text = within("cityObjectMember dem:MassPointRelief dem:reliefPoints gml:MultiPoint", points);
  EXPECT_EQ(read_citygml_text(model(text)).source.relief_points, corners_at_5);
}

TEST(CityGmlRelief, RastersAreCounted) {
  const std::string raster = within("dem:reliefComponent dem:RasterRelief dem:grid", "");
  const std::string lines =
      within("dem:reliefComponent dem:BreaklineRelief dem:breaklines gml:LineString gml:posList", "0 0 0 1 1 1");
  const Reading r = read_citygml_text(
      model(within("cityObjectMember dem:ReliefFeature", raster + lines) + building(surface("bldg:lod1MultiSurface", "a", "1"))));
  EXPECT_TRUE(r.source.relief_points.empty());
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"BreaklineRelief", 1}, {"RasterRelief", 1}}));
}

TEST(CityGmlRelief, UnreadablePointsAreLeftOut) {
  const std::string lists =
      within("gml:controlPoint gml:posList", "0 0 5 9 x 5 9 9 1e300 9 0 5 9") + within("gml:controlPoint gml:posList", "9 9 5");
  const Reading r = read_citygml_text(model(tin("<gml:Tin>" + lists + "</gml:Tin>")));
  EXPECT_EQ(r.source.relief_points, corners_at_5);
  ASSERT_EQ(r.codes(), std::set<int>{102});
  EXPECT_NE(r.report.problems()[0].detail.find(": 3"), std::string::npos) << r.report.problems()[0].detail;
  const std::string flat =
      R"(<gml:Tin><gml:controlPoint><gml:posList srsDimension="2">0 0 9 9</gml:posList></gml:controlPoint></gml:Tin>)";
  const Reading both = read_citygml_text(model(tin(flat) + tin("<gml:Tin>" + within("gml:pos", "0 0 5") + "</gml:Tin>")));
  EXPECT_EQ(both.source.relief_points.size(), 1u) << "the dimension of one terrain is not that of the next";
}

TEST(CityGmlRelief, ARealFileHasHouseAndGround) {
  FARLOD_NEEDS_DATA("formats");
  Reading r;
  r.source = read_citygml(shared_data("formats/Building_LOD3-EPSG25832.gml"), {}, r.report);
  EXPECT_EQ(surface_count(r.city()), 24u);
  ASSERT_EQ(r.source.relief_points.size(), 27u) << "nine triangles";
  EXPECT_EQ(r.source.relief_points[2], (Point3d{458883, 5438362, 114}));
}

}  // namespace
}  // namespace farlod::ingest::test
