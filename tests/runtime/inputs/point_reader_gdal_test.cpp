// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/vector_reader_gdal.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <fstream>
#include <functional>
#include <limits>

#include "farlod/point.hpp"
#include "inputs/requested_points.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> row_of(const Attributes& attributes, std::size_t row) {
  std::vector<std::string> values;
  for (std::size_t column = 0; column < attributes.names().size(); ++column) values.emplace_back(attributes.value(row, column));
  return values;
}

/// A file with layers, written by GDAL. Shapefiles are in GBK.
class VectorFile {
 public:
  VectorFile(const char* driver, const std::filesystem::path& path) {
    GDALAllRegister();
    dataset_.reset(GetGDALDriverManager()->GetDriverByName(driver)->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  }
  VectorFile& layer(const char* name, int epsg, OGRwkbGeometryType type,
                    const std::vector<std::pair<const char*, OGRFieldType>>& fields) {
    OGRSpatialReference crs;
    if (epsg != 0) crs.importFromEPSG(epsg);
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const bool is_shapefile = EQUAL(dataset_->GetDriverName(), "ESRI Shapefile");
    CPLStringList options;
    if (is_shapefile) options.SetNameValue("ENCODING", "GBK");
    layer_ = dataset_->CreateLayer(name, epsg == 0 ? nullptr : &crs, type, options.List());
    for (const auto& [field, kind] : fields) {
      OGRFieldDefn definition(field, kind);
      EXPECT_EQ(layer_->CreateField(&definition), OGRERR_NONE);
    }
    return *this;
  }
  VectorFile& feature(const char* wkt, const std::function<void(OGRFeature&)>& fill = {}) {
    OGRFeature feature(layer_->GetLayerDefn());
    OGRGeometry* geometry = nullptr;
    if (wkt != nullptr) {
      EXPECT_EQ(OGRGeometryFactory::createFromWkt(wkt, nullptr, &geometry), OGRERR_NONE);
      feature.SetGeometryDirectly(geometry);
    }
    if (fill) fill(feature);
    EXPECT_EQ(layer_->CreateFeature(&feature), OGRERR_NONE);
    return *this;
  }

 private:
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
};

std::string complaint_about(const std::filesystem::path& path, const std::string& layer = "") {
  return scenes::refusal_of<InputError>([&] { (void)read_points_gdal(path, layer); });
}

struct Format {
  const char *driver, *file;
};

class EachFormat : public testing::TestWithParam<Format> {
 protected:
  scenes::TemporaryFolder folder;
  std::filesystem::path path = folder.file(GetParam().file);
};

TEST_P(EachFormat, GivesPlacesFieldsAndCrs) {
  VectorFile(GetParam().driver, path)
      .layer("stations", 4326, wkbPoint25D,
             {{"id", OFTString}, {"note", OFTString}, {"count", OFTInteger64}, {"measured", OFTReal}})
      .feature("POINT Z (9.25 49.5 120.5)",
               [](OGRFeature& f) {
                 f.SetField("id", "north");
                 f.SetField("note", "a, \"b\"");
                 f.SetField("count", 7);
                 f.SetField("measured", 0.1 + 0.2);
               })
      .feature("POINT Z (-3.5 50 0)", [](OGRFeature& f) { f.SetField("id", "south"); });
  EXPECT_TRUE(is_vector_file(path));
  const RequestedPoints read = read_points_gdal(path, "");
  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points[0].x, 9.25);
  EXPECT_EQ(read.points[0].y, 49.5);
  EXPECT_EQ(read.points[0].z, 120.5);
  EXPECT_EQ(read.points[1].x, -3.5);
  EXPECT_EQ(read.points[0].id, "north");
  EXPECT_EQ(read.points[1].id, "south");
  EXPECT_FALSE(read.has_normals);
  EXPECT_THAT(*read.crs_wkt, HasSubstr("WGS 84"));
  EXPECT_THAT(read.notes, IsEmpty());
  const auto& names = read.attributes.names();
  const auto column = [&](const char* name) { return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()); };
  ASSERT_LT(column("measured"), names.size());
  EXPECT_EQ(std::ranges::count(names, "id"), 0);
  EXPECT_EQ(read.attributes.value(0, column("note")), "a, \"b\"");
  EXPECT_EQ(read.attributes.value(0, column("count")), "7");
  EXPECT_NEAR(std::stod(std::string(read.attributes.value(0, column("measured")))), 0.3, 1e-12);
  EXPECT_EQ(read.attributes.value(1, column("note")), "");
}

INSTANTIATE_TEST_SUITE_P(Points, EachFormat,
                         testing::Values(Format{"GPKG", "p.gpkg"}, Format{"GeoJSON", "p.geojson"},
                                         Format{"ESRI Shapefile", "p.shp"}, Format{"FlatGeobuf", "p.fgb"}),
                         [](const auto& tested) { return std::string(tested.param.file).substr(2); });

class PointReaderGdal : public testing::Test {
 protected:
  scenes::TemporaryFolder folder;
  std::filesystem::path path = folder.file("p.gpkg");
};

TEST_F(PointReaderGdal, NumbersHaveAllTheirDigits) {
  VectorFile("GPKG", path).layer("a", 25832, wkbPoint, {{"r", OFTReal}}).feature("POINT (1 2)", [](OGRFeature& f) {
    f.SetField("r", 0.1 + 0.2);
  });
  const RequestedPoints read = read_points_gdal(path, "");
  EXPECT_THAT(read.attributes.names(), ElementsAre("fid", "r"));
  EXPECT_THAT(row_of(read.attributes, 0), ElementsAre("1", "0.30000000000000004"));
  EXPECT_EQ(read.points[0].id, "1");
  EXPECT_FALSE(read.points[0].z);
}

TEST_F(PointReaderGdal, EachPointOfAMultipointHasTheFields) {
  VectorFile("GPKG", path)
      .layer("a", 25832, wkbMultiPoint, {{"name", OFTString}})
      .feature("MULTIPOINT ((1 2), (3 4))", [](OGRFeature& f) { f.SetField("name", "pair"); });
  const RequestedPoints read = read_points_gdal(path, "");
  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points[1].x, 3.0);
  EXPECT_EQ(read.points[1].id, "pair");
  EXPECT_THAT(row_of(read.attributes, 1), ElementsAre("1", "pair"));
}

TEST_F(PointReaderGdal, WhatIsNoPointIsCounted) {
  VectorFile("GPKG", path)
      .layer("a", 25832, wkbUnknown, {})
      .feature("POINT (1 2)")
      .feature("LINESTRING (0 0, 1 1)")
      .feature("POINT EMPTY")
      .feature(nullptr);
  const RequestedPoints read = read_points_gdal(path, "");
  EXPECT_EQ(read.points.size(), 1U);
  EXPECT_EQ(read.skipped_features, 3U);
  EXPECT_THAT(read.notes, ElementsAre(HasSubstr("3 features of ")));
}

TEST_F(PointReaderGdal, NoPointsAtAllAreRefused) {
  VectorFile("GPKG", path).layer("a", 25832, wkbPolygon, {}).feature("POLYGON ((0 0, 1 0, 1 1, 0 0))");
  EXPECT_THAT(complaint_about(path), HasSubstr("none of its 1 features is one"));
  VectorFile("GPKG", folder.file("empty.gpkg")).layer("a", 25832, wkbPoint, {});
  EXPECT_THAT(complaint_about(folder.file("empty.gpkg")), HasSubstr("its layer is empty"));
  EXPECT_THAT(complaint_about(folder.file("lost.gpkg")), HasSubstr("does not exist"));
  std::ofstream(folder.file("broken.gpkg")) << "SQLite format 3";
  EXPECT_THAT(complaint_about(folder.file("broken.gpkg")), HasSubstr("cannot be read as a vector file"));
}

TEST_F(PointReaderGdal, NumbersThatAreNoneAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto place = [](double x, double y, double z) {
    return [=](OGRFeature& f) { f.SetGeometryDirectly(new OGRPoint(x, y, z)); };
  };
  VectorFile("GPKG", path)
      .layer("a", 25832, wkbPoint25D, {})
      .feature(nullptr, place(1.0, 2.0, 3.0))
      .feature(nullptr, place(1.0, 2.0, nan));
  EXPECT_THAT(complaint_about(path), HasSubstr("feature 2 of the layer \"a\": its z is not a number"));
  VectorFile("GPKG", folder.file("x.gpkg"))
      .layer("a", 25832, wkbPoint25D, {})
      .feature(nullptr, place(1.0, std::numeric_limits<double>::infinity(), 3.0));
  EXPECT_THAT(complaint_about(folder.file("x.gpkg")), HasSubstr("a coordinate is not a number"));
}

TEST_F(PointReaderGdal, OfSeveralLayersOneIsChosen) {
  VectorFile("GPKG", path)
      .layer("trees", 25832, wkbPoint, {})
      .feature("POINT (1 2)")
      .layer("stations", 25832, wkbPoint, {})
      .feature("POINT (3 4)");
  EXPECT_THAT(complaint_about(path), HasSubstr("choose one by --points-layer, of trees, stations"));
  EXPECT_THAT(complaint_about(path, "roofs"), HasSubstr("no layer \"roofs\": give one of trees, stations as --points-layer"));
  EXPECT_EQ(read_points_gdal(path, "stations").points.at(0).x, 3.0);
}

TEST_F(PointReaderGdal, TextsAreUtf8) {
  const std::string name_in_chinese = "\xe9\xab\x98\xe5\xba\xa6";
  path = folder.file("a.shp");
  VectorFile("ESRI Shapefile", path).layer("a", 25832, wkbPoint, {{"id", OFTString}}).feature("POINT (1 2)", [&](OGRFeature& f) {
    f.SetField("id", name_in_chinese.c_str());
  });
  EXPECT_EQ(read_points_gdal(path, "").points.at(0).id, name_in_chinese);
  std::filesystem::remove(folder.file("a.cpg"));
  std::fstream table(folder.file("a.dbf"), std::ios::in | std::ios::out | std::ios::binary);
  constexpr std::streamoff place_of_the_encoding = 29;
  table.seekp(place_of_the_encoding);
  table.put('\0');
  table.close();
  EXPECT_THAT(complaint_about(path), HasSubstr("not UTF-8: give it a .cpg file that says what they are in, such as GBK"));
}

LineSampling every(double spacing_m, const std::string& crs = "") { return {spacing_m, crs, "EPSG:25832"}; }

TEST_F(PointReaderGdal, ALayerMayBeReadAsATable) {
  {
    VectorFile file("GPKG", path);
    file.layer("receivers", 25832, wkbPoint, {{"svf", OFTReal}}).feature("POINT (1 2)");
    file.layer("surfaces", 0, wkbNone, {{"building", OFTString}, {"surface", OFTInteger}});
    file.feature(nullptr, [](OGRFeature& f) {
      f.SetField("building", "a");
      f.SetField("surface", 7);
    });
  }
  const std::optional<Attributes> table = read_table_gdal(path, "surfaces");
  ASSERT_TRUE(table);
  EXPECT_THAT(table->names(), ElementsAre("fid", "building", "surface"));
  EXPECT_THAT(row_of(*table, 0), ElementsAre("1", "a", "7"));
  EXPECT_FALSE(read_table_gdal(path, "buildings"));
  EXPECT_FALSE(read_table_gdal(folder.file("none.gpkg"), "surfaces"));
}

TEST_F(PointReaderGdal, PointsAlongLinesStandInTheMiddlesOfEqualParts) {
  VectorFile("GPKG", path)
      .layer("axes", 25832, wkbLineString, {{"street", OFTString}, {"along_m", OFTInteger}})
      .feature("LINESTRING (600000 5000000, 600010 5000000, 600010 5000005)",
               [](OGRFeature& f) {
                 f.SetField("street", "bent");
                 f.SetField("along_m", 7);
               })
      .feature("LINESTRING (600000 5000100, 600001 5000100)")
      .feature("POINT (1 2)")
      .feature("LINESTRING (600000 5000200, 600000 5000200)");
  const RequestedPoints read = read_lines_gdal(path, "", every(4.0));
  ASSERT_EQ(read.points.size(), 5U) << "15 m in four parts, and a short one";
  const std::vector<Point2d> expected{
      {600001.875, 5000000}, {600005.625, 5000000}, {600009.375, 5000000}, {600010, 5000003.125}, {600000.5, 5000100}};
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_NEAR(read.points[n].x, expected[n].x, 1e-6) << n;
    EXPECT_NEAR(read.points[n].y, expected[n].y, 1e-6) << n;
    EXPECT_EQ(read.points[n].id, std::to_string(n + 1));
  }
  EXPECT_THAT(read.attributes.names(), ElementsAre("fid", "street", "along_m_input", "along_m"));
  EXPECT_THAT(row_of(read.attributes, 3), ElementsAre("1", "bent", "7", "13.125"));
  EXPECT_EQ(read.skipped_features, 1U);
  EXPECT_THAT(read.notes, ElementsAre(HasSubstr("1 feature of ")));
}

TEST_F(PointReaderGdal, LinesAreMeasuredInTheMetresOfThePackage) {
  VectorFile("GeoJSON", folder.file("axes.geojson"))
      .layer("axes", 4326, wkbMultiLineString, {})
      .feature("MULTILINESTRING ((9 49, 9 49.001), (9.01 49, 9.01 49.0005))");
  const RequestedPoints read = read_lines_gdal(folder.file("axes.geojson"), "", every(10.0));
  // A thousandth of a degree along a meridian is 111.2 m; UTM's scale there is .9996
  EXPECT_EQ(read.points.size(), 12U + 6U);
  EXPECT_NEAR(read.points[0].x, 500000.0, 0.01);
  EXPECT_NEAR(norm(Point2d{read.points[1].x - read.points[0].x, read.points[1].y - read.points[0].y}), 111.16 / 12.0, 0.01);
}

TEST_F(PointReaderGdal, FilesWithoutLinesAreRefused) {
  VectorFile("GPKG", path).layer("a", 25832, wkbPoint, {}).feature("POINT (1 2)");
  EXPECT_THAT(scenes::refusal_of<PointsError>([&] { (void)read_lines_gdal(path, "", every(1.0)); }),
              HasSubstr("holds no lines: none of its 1 features is one"));
}

TEST_F(PointReaderGdal, AzimuthAndTiltAreANormal) {
  VectorFile("GPKG", path)
      .layer("a", 25832, wkbPoint, {{"azimuth", OFTInteger}, {"Tilt", OFTReal}})
      .feature("POINT (1 2)",
               [](OGRFeature& f) {
                 f.SetField("azimuth", 180);
                 f.SetField("Tilt", 30.5);
               })
      .feature("POINT (1 2)");
  const RequestedPoints read = read_points_gdal(path, "");
  EXPECT_TRUE(read.has_normals);
  EXPECT_EQ(read.points[0].normal->azimuth_deg, 180.0);
  EXPECT_EQ(read.points[0].normal->tilt_deg, 30.5);
  EXPECT_FALSE(read.points[1].normal);
  EXPECT_THAT(read.attributes.names(), ElementsAre("fid"));
  VectorFile("GPKG", folder.file("half.gpkg"))
      .layer("a", 25832, wkbPoint, {{"azimuth", OFTReal}, {"tilt", OFTReal}})
      .feature("POINT (1 2)", [](OGRFeature& f) { f.SetField("azimuth", 90.0); });
  EXPECT_THAT(complaint_about(folder.file("half.gpkg")),
              HasSubstr("feature 1 of the layer \"a\": there is an azimuth and no tilt"));
}

TEST_F(PointReaderGdal, AFileMaySayNoCrs) {
  VectorFile("GPKG", path).layer("a", 0, wkbPoint, {}).feature("POINT (1 2)");
  EXPECT_EQ(read_points_gdal(path, "").crs_wkt, "");
}

TEST_F(PointReaderGdal, TablesAreNotForIt) {
  for (const char* name : {"a.csv", "a.CSV", "a.txt", "a.tsv", "a", "a.points"}) EXPECT_FALSE(is_vector_file(name)) << name;
}

class RegionReader : public testing::Test {
 protected:
  /// A GeoJSON file of these geometries, in a CRS unless its name is empty.
  std::filesystem::path file_of(const std::string& geometries, const std::string& crs) {
    const std::filesystem::path path = folder_.file("mask.geojson");
    std::ofstream file(path);
    file << R"({"type": "FeatureCollection", )";
    if (!crs.empty()) file << R"("crs": {"type": "name", "properties": {"name": ")" << crs << R"("}}, )";
    file << R"("features": [{"type": "Feature", "properties": {}, "geometry": {"type": "GeometryCollection", "geometries": [)"
         << geometries << "]}}]}";
    return path;
  }
  static std::string complaint_about(const std::filesystem::path& path) {
    return scenes::refusal_of<PointsError>([&] { (void)read_region_gdal(path, "EPSG:25832"); });
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(RegionReader, TakesPolygonsToTheCrsOfThePackage) {
  // 9° is the middle meridian of UTM 32: a degree of latitude there is 111.1 km
  const Region region = read_region_gdal(
      file_of(R"({"type": "Polygon", "coordinates": [[[8.9, 49], [9.1, 49], [9.1, 50], [8.9, 50], [8.9, 49]]]})", "EPSG:4326"),
      "EPSG:25832");
  EXPECT_TRUE(region.contains({500000.0, 5430000.0 + 50000.0}));
  EXPECT_FALSE(region.contains({500000.0, 5427000.0}));
  EXPECT_FALSE(region.contains({480000.0, 5480000.0}));
}

TEST_F(RegionReader, TakesHolesAndMultipolygonsAndLeavesTheRest) {
  const Region region =
      read_region_gdal(file_of(R"({"type": "MultiPolygon", "coordinates": [[[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]],
                                                              [[4, 4], [6, 4], [6, 6], [4, 6], [4, 4]]],
                                                             [[[20, 0], [30, 0], [30, 10], [20, 0]]]]},
                 {"type": "LineString", "coordinates": [[0, 0], [100, 100]]}, {"type": "Point", "coordinates": [50, 50]})",
                               "EPSG:25832"),
                       "EPSG:25832");
  EXPECT_TRUE(region.contains({1, 1}));
  EXPECT_FALSE(region.contains({5, 5}));
  EXPECT_TRUE(region.contains({28, 5}));
  EXPECT_EQ(region.outline(), (Box2d{{0, 0}, {30, 10}}));
}

TEST_F(RegionReader, RefusesWhatHoldsNoPolygons) {
  EXPECT_THAT(complaint_about(file_of(R"({"type": "Point", "coordinates": [1, 2]})", "EPSG:25832")),
              testing::HasSubstr("holds no polygons"));
  EXPECT_THAT(complaint_about(folder_.file("lost.gpkg")), testing::HasSubstr("does not exist"));
  std::ofstream(folder_.file("broken.gpkg")) << "SQLite format 3";
  EXPECT_THAT(complaint_about(folder_.file("broken.gpkg")), testing::HasSubstr("cannot be read as a vector file"));
}

}  // namespace
}  // namespace farlod
