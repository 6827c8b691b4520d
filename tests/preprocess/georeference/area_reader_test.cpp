// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/area_reader.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include "base/point_columns.hpp"
#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod::georeference {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class AreaReader : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.file(name); }
  /// The city frame of EPSG:32632 with its origin at (500000, 5500000).
  [[nodiscard]] static Area read(const std::filesystem::path& path) {
    return located(read_area(path), georeference_around({500000.0, 5500000.0}, *Crs::find("EPSG:32632")));
  }
  [[nodiscard]] static std::string refusal(const std::filesystem::path& path) {
    return scenes::refusal_of<InputError>([&] { (void)read(path); });
  }
  [[nodiscard]] std::vector<Point2d> points_in(const std::string& table) const { return read(write("p.csv", table)).points; }

 private:
  scenes::TemporaryFolder folder_;
};

std::string geojson(const std::string& geometry, const std::string& crs = "") {
  return R"({"type":"FeatureCollection",)" + crs + R"("features":[{"type":"Feature","properties":{},"geometry":)" + geometry +
         "}]}";
}
const std::string in_utm = R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32632"}},)";

TEST_F(AreaReader, ReadsPolygonsWithTheirHoles) {
  const Area area = read(write("quarter.geojson", geojson(R"({"type":"Polygon","coordinates":[
      [[500010,5500020],[500050,5500020],[500050,5500060],[500010,5500020]],
      [[500030,5500025],[500035,5500025],[500035,5500030],[500030,5500025]]]})",
                                                          in_utm)));
  ASSERT_EQ(area.shape_count(), 1U);
  ASSERT_EQ(area.polygons[0].size(), 2U);
  EXPECT_EQ(area.polygons[0][0][0], (Point2d{10, 20}));
  EXPECT_EQ(area.polygons[0][1][0], (Point2d{30, 25}));
}

TEST_F(AreaReader, ReadsLinesPointsAndCollections) {
  const Area area = read(write("all.geojson", geojson(R"({"type":"GeometryCollection","geometries":[
      {"type":"MultiPoint","coordinates":[[500001,5500002],[500003,5500004]]},
      {"type":"LineString","coordinates":[[500001,5500002],[500003,5500004]]},
      {"type":"MultiPolygon","coordinates":[[[[500000,5500000],[500001,5500000],[500001,5500001],[500000,5500000]]]]}]})",
                                                      in_utm)));
  EXPECT_THAT(area.points, ElementsAre(Point2d{1, 2}, Point2d{3, 4}));
  ASSERT_EQ(area.lines.size(), 1U);
  EXPECT_THAT(area.lines[0], ElementsAre(Point2d{1, 2}, Point2d{3, 4}));
  EXPECT_EQ(area.polygons.size(), 1U);
}

/// GeographicLib is the judge of PROJ.
TEST_F(AreaReader, TransformsDegrees) {
  const Area area = read(write("p.geojson", geojson(R"({"type":"LineString","coordinates":[[9.0,49.65],[9.01,49.66]]})")));
  constexpr Ellipsoid wgs84{6378137.0, 298.257223563};
  const UtmProjection utm({32, true}, wgs84);
  ASSERT_EQ(area.lines.size(), 1U);
  const std::vector<Point2d> degrees{{9.0, 49.65}, {9.01, 49.66}};
  for (std::size_t n = 0; n < degrees.size(); ++n) {
    const Point2d expected = *utm.projected(degrees[n]) - Point2d{500000.0, 5500000.0};
    constexpr double millimetre = 1e-3;
    EXPECT_NEAR(area.lines[0][n].x, expected.x, millimetre);
    EXPECT_NEAR(area.lines[0][n].y, expected.y, millimetre);
  }
}

/// Makes a file of two layers, of a point each.
void make_layers(const std::filesystem::path& path, const char* driver, const char* crs) {
  GDALAllRegister();
  OGRSpatialReference reference;
  if (crs != nullptr) reference.SetFromUserInput(crs);
  GDALDatasetUniquePtr dataset(
      GetGDALDriverManager()->GetDriverByName(driver)->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  for (const char* name : {"one", "two"}) {
    OGRLayer* layer = dataset->CreateLayer(name, crs != nullptr ? &reference : nullptr, wkbPoint, nullptr);
    const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
    const OGRPoint point(500007.0, 5500008.0);
    feature->SetGeometry(&point);
    ASSERT_EQ(layer->CreateFeature(feature.get()), OGRERR_NONE);
  }
}

TEST_F(AreaReader, ReadsAllLayersOfAGeoPackage) {
  make_layers(file("a.gpkg"), "GPKG", "EPSG:32632");
  EXPECT_THAT(read(file("a.gpkg")).points, ElementsAre(Point2d{7, 8}, Point2d{7, 8}));
}

TEST_F(AreaReader, WithoutACrsCoordinatesAreThoseOfThePackage) {
  make_layers(file("shapes"), "ESRI Shapefile", nullptr);
  EXPECT_THAT(read(file("shapes") / "one.shp").points, ElementsAre(Point2d{7, 8}));
}

TEST_F(AreaReader, ReadsTheTablesOfPointsThatFarlodSvfReads) {
  EXPECT_THAT(points_in("id,x,y,z\na,500001,5500002,3\nb,500004.5,+5500005,\n"), ElementsAre(Point2d{1, 2}, Point2d{4.5, 5}));
  EXPECT_THAT(points_in("Y;X\n5500002;500001\n"), ElementsAre(Point2d{1, 2}));
  EXPECT_THAT(points_in("x\ty\n500001\t5500002\n"), ElementsAre(Point2d{1, 2}));
  EXPECT_THAT(points_in("500001,5500002\n500003,5500004\n"), ElementsAre(Point2d{1, 2}, Point2d{3, 4}));
  EXPECT_THAT(points_in("500001,5500002,7\n"), ElementsAre(Point2d{1, 2}));
  EXPECT_THAT(points_in("\"x\",\"y\"\r\n\"500001\",\"5500002\"\r\n\r\n"), ElementsAre(Point2d{1, 2}));
  EXPECT_THAT(read(write("p.txt", "x,y\n500001,5500002\n")).points, ElementsAre(Point2d{1, 2}));
  for (const std::string_view x : point_columns::x_names)
    for (const std::string_view y : point_columns::y_names)
      EXPECT_THAT(points_in(std::string(x) + "," + std::string(y) + "\n500001,5500002\n"), ElementsAre(Point2d{1, 2}));
}

TEST_F(AreaReader, SaysWhatIsWrongWithATable) {
  EXPECT_THAT(refusal(write("a.csv", "name,height\na,3\n")), HasSubstr("no column is named x and y"));
  EXPECT_THAT(refusal(write("b.csv", "x,y\n1,two\n")), HasSubstr("\"two\" is not a number"));
  EXPECT_THAT(refusal(write("c.csv", "x,y\n1,\n")), HasSubstr("is not a number"));
  EXPECT_THAT(refusal(write("d.csv", "x,y\n1,nan\n")), HasSubstr("is not a number"));
  EXPECT_THAT(refusal(write("e.csv", "x,y\n")), HasSubstr("no points"));
  EXPECT_THAT(refusal(write("f.csv", "x,y,easting\n1,2,3\n")), HasSubstr("mean the same"));
}

TEST_F(AreaReader, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(refusal(file("lost.gpkg")), HasSubstr("lost.gpkg does not exist"));
  EXPECT_THAT(refusal(write("text.gpkg", "no geometry")), HasSubstr("cannot be read as an area"));
  EXPECT_THAT(refusal(write("none.geojson", R"({"type":"FeatureCollection","features":[]})")), HasSubstr("no points"));
  EXPECT_THAT(refusal(write("far.geojson", geojson(R"({"type":"Point","coordinates":[500001,5500002]})"))),
              AllOf(HasSubstr("no place in WGS 84 / UTM zone 32N"), HasSubstr("ogr2ogr -a_srs EPSG:n")));
}

}  // namespace
}  // namespace farlod::georeference
