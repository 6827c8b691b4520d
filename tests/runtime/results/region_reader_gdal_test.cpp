// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/region_reader_gdal.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "inputs/requested_points.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

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
    try {
      (void)read_region_gdal(path, "EPSG:25832");
    } catch (const PointsError& error) {
      return error.what();
    }
    return "no complaint";
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
  EXPECT_THAT(complaint_about(folder_.file("lost.gpkg")), testing::HasSubstr("cannot be read"));
  std::ofstream(folder_.file("broken.gpkg")) << "SQLite format 3";
  EXPECT_THAT(complaint_about(folder_.file("broken.gpkg")), testing::HasSubstr("cannot be read as a vector file"));
}

}  // namespace
}  // namespace farlod
