// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/raster_plan_gdal.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>

#include <array>

#include "inputs/requested_points.hpp"
#include "results/raster/raster_writer_gdal.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

class RasterGridReader : public testing::Test {
 protected:
  /// A raster with this geotransform, in UTM 32 unless `crs` is another.
  std::filesystem::path raster_with(std::array<double, 6> geotransform, const std::string& crs = small_raster().crs_wkt) {
    const std::filesystem::path path = folder_.file("a.tif");
    GDALAllRegister();
    const GDALDatasetUniquePtr dataset(
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 100, 50, 1, GDT_Byte, nullptr));
    dataset->SetGeoTransform(geotransform.data());
    dataset->SetProjection(crs.c_str());
    return path;
  }
  static std::string complaint_about(const std::filesystem::path& path) {
    try {
      (void)read_raster_grid_gdal(path, "EPSG:25832");
    } catch (const PointsError& error) {
      return error.what();
    }
    return "no complaint";
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(RasterGridReader, GivesThePixelsBackThatWereWritten) {
  write_whole<GeotiffWriter>(small_raster(), folder_.file("a.tif"));
  const RasterGrid grid = read_raster_grid_gdal(folder_.file("a.tif"), "EPSG:25832");
  EXPECT_TRUE(grid.says_crs);
  EXPECT_EQ(grid.plan.north_west_m, small_raster().north_west_m);
  EXPECT_EQ(grid.plan.step_m, small_raster().step_m);
  EXPECT_EQ(grid.plan.columns, small_raster().columns);
  EXPECT_EQ(grid.plan.rows, small_raster().rows);
}

TEST_F(RasterGridReader, TakesPixelsThatAreOffByTheirDigits) {
  EXPECT_EQ(complaint_about(raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.0, -2.0000001})), "no complaint");
}

TEST_F(RasterGridReader, KnowsThatACrsIsTheSameUnderAnotherName) {
  const std::filesystem::path path = raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.0, -2.0}, "EPSG:32632");
  EXPECT_EQ(complaint_about(path), "no complaint");
}

TEST_F(RasterGridReader, RefusesPixelsThatAreNoReceivers) {
  EXPECT_THAT(complaint_about(raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.0, -3.0})), HasSubstr("no squares"));
  EXPECT_THAT(complaint_about(raster_with({500000.0, 2.0, 0.1, 5700000.0, 0.0, -2.0})), HasSubstr("north up"));
  EXPECT_THAT(complaint_about(raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.1, -2.0})), HasSubstr("north up"));
  EXPECT_THAT(complaint_about(raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.0, 2.0})), HasSubstr("north up"));
  EXPECT_THAT(complaint_about(raster_with({500000.0, -2.0, 0.0, 5700000.0, 0.0, 2.0})), HasSubstr("north up"));
}

TEST_F(RasterGridReader, RefusesAnotherCrs) {
  const std::array<double, 6> place{500000.0, 2.0, 0.0, 5700000.0, 0.0, -2.0};
  EXPECT_THAT(complaint_about(raster_with(place, "EPSG:25833")), HasSubstr("another CRS"));
  EXPECT_THAT(complaint_about(raster_with({9.0, 0.001, 0.0, 51.0, 0.0, -0.001}, "EPSG:4326")), HasSubstr("another CRS"));
}

TEST_F(RasterGridReader, RefusesWhatIsNoRaster) {
  EXPECT_THAT(complaint_about(folder_.file("lost.tif")), HasSubstr("see that it exists"));
  EXPECT_THAT(complaint_about(folder_.path()), HasSubstr("cannot be read as a raster"));
}

}  // namespace
}  // namespace farlod
