// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/zone_reader_gdal.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <fstream>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/point.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* zone_crs = "EPSG:25832";

class ZoneReader : public testing::Test {
 protected:
  /// A layer more of a GeoPackage, with a field `name`, and a feature for each geometry, called 0, 1, …
  void add_layer(const char* name, OGRwkbGeometryType type, const std::vector<const char*>& geometries) {
    GDALAllRegister();
    const bool is_there = std::filesystem::exists(path);
    const GDALDatasetUniquePtr file(
        is_there ? GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE)
                 : GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRSpatialReference crs;
    crs.importFromEPSG(25832);
    OGRLayer& layer = *file->CreateLayer(name, &crs, type, nullptr);
    OGRFieldDefn field("name", OFTString);
    EXPECT_EQ(layer.CreateField(&field), OGRERR_NONE);
    for (std::size_t n = 0; n < geometries.size(); ++n) {
      OGRFeature feature(layer.GetLayerDefn());
      OGRGeometry* geometry = nullptr;
      EXPECT_EQ(OGRGeometryFactory::createFromWkt(geometries[n], nullptr, &geometry), OGRERR_NONE);
      feature.SetGeometryDirectly(geometry);
      feature.SetField("name", std::to_string(n).c_str());
      EXPECT_EQ(layer.CreateFeature(&feature), OGRERR_NONE);
    }
  }
  [[nodiscard]] std::string complaint(const std::string& layer = "") const {
    return scenes::refusal_of<InputError>([&] { (void)read_zones_gdal(path, layer, zone_crs); });
  }

  scenes::TemporaryFolder folder;
  std::filesystem::path path = folder.file("zones.gpkg");
};

TEST_F(ZoneReader, EachFeatureIsAZoneWithItsFieldsHolesAndParts) {
  add_layer("blocks", wkbUnknown,
            {"POLYGON ((0 0, 0 10, 10 10, 10 0, 0 0), (4 4, 6 4, 6 6, 4 6, 4 4))",
             "MULTIPOLYGON (((20 0, 30 0, 30 10, 20 0)), ((40 0, 50 0, 50 10, 40 0)))"});
  const RequestedZones read = read_zones_gdal(path, "", zone_crs);
  ASSERT_EQ(read.zones.size(), 2U);
  ASSERT_EQ(read.zones[0].size(), 1U);
  // Whatever the file has, shells are counter-clockwise and holes clockwise
  EXPECT_THAT(read.zones[0][0].shell, ElementsAre(Point2d{10, 0}, Point2d{10, 10}, Point2d{0, 10}, Point2d{0, 0}));
  ASSERT_EQ(read.zones[0][0].holes.size(), 1U);
  EXPECT_THAT(read.zones[0][0].holes[0], ElementsAre(Point2d{4, 6}, Point2d{6, 6}, Point2d{6, 4}, Point2d{4, 4}));
  EXPECT_EQ(read.zones[1].size(), 2U);
  EXPECT_THAT(read.attributes.names(), ElementsAre("fid", "name"));
  EXPECT_EQ(read.attributes.value(1, 1), "1");
}

TEST_F(ZoneReader, TakesPolygonsToTheCrsOfThePackage) {
  std::ofstream(folder.file("zones.geojson"))
      << R"({"type": "Polygon", "coordinates": [[[8.9, 49], [9.1, 49], [9.1, 50], [8.9, 50], [8.9, 49]]]})";
  // 9° is the middle meridian of UTM 32
  const RequestedZones read = read_zones_gdal(folder.file("zones.geojson"), "", zone_crs);
  const std::vector<Point2d>& shell = read.zones.at(0).at(0).shell;
  ASSERT_EQ(shell.size(), 4U);
  EXPECT_NEAR(shell[0].x + shell[1].x, 1'000'000.0, 1e-3);
  EXPECT_NEAR(shell[0].y, 5'427'000.0, 2'000.0);
}

TEST_F(ZoneReader, OneOfSeveralLayersIsNamed) {
  add_layer("places", wkbPoint, {"POINT (1 2)"});
  add_layer("blocks", wkbPolygon, {"POLYGON ((0 0, 10 0, 10 10, 0 0))"});
  EXPECT_EQ(read_zones_gdal(path, "", zone_crs).zones.size(), 1U) << "points are no zones";
  add_layer("squares", wkbPolygon, {"POLYGON ((0 0, 10 0, 10 10, 0 0))", "POLYGON ((0 0, 10 0, 10 10, 0 0))"});
  EXPECT_EQ(read_zones_gdal(path, "squares", zone_crs).zones.size(), 2U);
  EXPECT_THAT(complaint(), HasSubstr("choose one by --zones-layer, of blocks, squares"));
  EXPECT_THAT(complaint("streets"), HasSubstr("give one of blocks, squares as --zones-layer"));
  EXPECT_THAT(complaint("places"), HasSubstr("the layer places holds no polygons"));
}

TEST_F(ZoneReader, WhatIsNoZoneIsRefused) {
  EXPECT_THAT(complaint(), HasSubstr("zones.gpkg does not exist"));
  add_layer("lines", wkbUnknown, {"POLYGON ((0 0, 10 0, 10 10, 0 0))", "LINESTRING (0 0, 10 0)"});
  EXPECT_THAT(complaint(), HasSubstr("feature 2 of the layer \"lines\" is no polygon"));
  add_layer("flat", wkbUnknown, {"POLYGON ((0 0, 10 0, 20 0, 0 0))"});
  EXPECT_THAT(complaint("flat"), HasSubstr("feature 1 of the layer \"flat\" has no area"));
  add_layer("none", wkbPolygon, {});
  EXPECT_THAT(complaint("none"), HasSubstr("its layer is empty"));
}

}  // namespace
}  // namespace farlod
