// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <limits>

#include "inputs/raster_reader_gdal.hpp"
#include "inputs/requested_points.hpp"
#include "results/output_format.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/raster/raster_writers.hpp"
#include "tests/runtime/results/raster/read_by_gdal.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

// Rasters of many tiles, as the programs write them: read back by GDAL.

namespace farlod {
namespace {

using testing::HasSubstr;
using testing::NanSensitiveFloatEq;
using testing::Pointwise;

/// Two tiles by three, of which the last are cut; each pixel another value, some without.
WholeRaster raster_of_six_tiles() {
  WholeRaster raster;
  raster.north_west_m = {1000.0, 2000.0};
  raster.columns = raster_tile_edge + 30;
  raster.rows = 2 * raster_tile_edge + 3;
  raster.bands = svf_bands("svf", RasterBands::svf_and_bounds);
  const auto count = static_cast<float>(raster.columns * raster.rows);
  for (std::size_t n = 0; n < raster.columns * raster.rows; ++n) {
    const float svf = n % 7 == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(n) / count;
    raster.svf.push_back(svf);
    raster.low.push_back(0.5F * svf);
    raster.high.push_back(0.5F * svf + 0.5F);
  }
  return raster;
}

/// The tiles of the raster, the last first.
std::vector<RasterTile> backwards(const WholeRaster& raster) {
  std::vector<RasterTile> tiles = tiles_of(raster);
  std::reverse(tiles.begin(), tiles.end());
  return tiles;
}

void write_backwards(RasterWriter& writer, const WholeRaster& raster) {
  for (const RasterTile& tile : backwards(raster)) writer.write(tile);
  writer.commit();
}

/// A raster without the first of its tiles, which is without answers in it.
struct WithoutOneTile {
  WholeRaster raster = raster_of_six_tiles();
  std::vector<RasterTile> tiles = backwards(raster);

  WithoutOneTile() {
    tiles.pop_back();
    for (std::size_t row = 0; row < raster_tile_edge; ++row)
      for (std::size_t column = 0; column < raster_tile_edge; ++column)
        for (auto* band : {&raster.svf, &raster.low, &raster.high})
          (*band)[row * raster.columns + column] = std::numeric_limits<float>::quiet_NaN();
  }
};

TEST(PngTiles, MakeTheSamePictureInWhateverOrderTheyCome) {
  const scenes::TemporaryFolder folder;
  const WholeRaster raster = raster_of_six_tiles();
  PreviewWriter writer(raster, folder.file("a.png"));
  write_backwards(writer, raster);
  write_whole<made<PreviewWriter>>(raster, folder.file("b.png"));
  EXPECT_EQ(scenes::text_of(folder.file("a.png")), scenes::text_of(folder.file("b.png")));
}

/// The formats of rasters and pictures, and a file of each.
template <class Action>
void for_each_raster_format(const Action& action) {
  for (const OutputFormat& format : output_formats()) {
    if (format.raster_writer == nullptr) continue;
    SCOPED_TRACE(format.name);
    const scenes::TemporaryFolder folder;
    action(format, folder.file("a" + std::string(format.endings[0])));
  }
}

/// The file holds these values, NaN where it declares that there is no data.
void expect_values(const OutputFormat& format, const WholeRaster& raster, const std::filesystem::path& path) {
  for (const int band : {1, 2, 3}) {
    if (band > 1 && !format.holds_bounds) continue;
    const GDALDatasetUniquePtr dataset = dataset_of(path, band);
    std::vector<float> pixels = pixels_of(*dataset, band);
    const auto nodata = static_cast<float>(dataset->GetRasterBand(1)->GetNoDataValue());
    std::replace(pixels.begin(), pixels.end(), nodata, std::numeric_limits<float>::quiet_NaN());
    EXPECT_THAT(pixels, Pointwise(NanSensitiveFloatEq(), band == 1 ? raster.svf : band == 2 ? raster.low : raster.high)) << band;
  }
}

TEST(RasterFormats, HoldTheSameValuesInWhateverOrderTilesCome) {
  for_each_raster_format([](const OutputFormat& format, const std::filesystem::path& path) {
    if (!format.holds_rasters()) return;
    const WholeRaster raster = raster_of_six_tiles();
    write_backwards(*format.raster_writer(raster, path), raster);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1) << "files";
    expect_values(format, raster, path);
  });
}

TEST(RasterFormats, WhatDoesNotComeHasNoData) {
  for_each_raster_format([](const OutputFormat& format, const std::filesystem::path& path) {
    if (!format.holds_rasters()) return;
    const WithoutOneTile without;
    const auto writer = format.raster_writer(without.raster, path);
    for (const RasterTile& tile : without.tiles) writer->write(tile);
    writer->commit();
    expect_values(format, without.raster, path);
  });
}

TEST(RasterFormats, TheSameOrderMakesTheSameBytes) {
  for_each_raster_format([](const OutputFormat& format, const std::filesystem::path& path) {
    const WholeRaster raster = raster_of_six_tiles();
    const auto bytes = [&](const std::filesystem::path& file) {
      write_backwards(*format.raster_writer(raster, file), raster);
      return scenes::text_of(file);
    };
    const std::string first = bytes(path);
    EXPECT_FALSE(first.empty());
    EXPECT_TRUE(bytes(path) == first);
    EXPECT_TRUE(bytes(path.parent_path() / ("b" + path.extension().string())) == first) << "in a file of another name";
  });
}

TEST(RasterFormats, NothingIsLeftOfAFileThatIsGivenUp) {
  for_each_raster_format([](const OutputFormat& format, const std::filesystem::path& path) {
    const WholeRaster raster = raster_of_six_tiles();
    {
      const auto writer = format.raster_writer(raster, path);
      for (const RasterTile& tile : tiles_of(raster)) writer->write(tile);
    }
    EXPECT_TRUE(std::filesystem::is_empty(path.parent_path()));
  });
}

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
    return scenes::refusal_of<PointsError>([&] { (void)read_raster_grid_gdal(path, "EPSG:25832"); });
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(RasterGridReader, GivesThePixelsBackThatWereWritten) {
  write_whole<geotiff_writer>(small_raster(), folder_.file("a.tif"));
  const RasterGrid grid = read_raster_grid_gdal(folder_.file("a.tif"), "EPSG:25832");
  EXPECT_TRUE(grid.says_crs);
  EXPECT_EQ(grid.plan.north_west_m, small_raster().north_west_m);
  EXPECT_EQ(grid.plan.step_m, small_raster().step_m);
  EXPECT_EQ(grid.plan.columns, small_raster().columns);
  EXPECT_EQ(grid.plan.rows, small_raster().rows);
}

TEST_F(RasterGridReader, TakesPixelsThatAreOffByTheirDigits) {
  EXPECT_EQ(complaint_about(raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.0, -2.0000001})), "no refusal");
}

TEST_F(RasterGridReader, KnowsThatACrsIsTheSameUnderAnotherName) {
  const std::filesystem::path path = raster_with({500000.0, 2.0, 0.0, 5700000.0, 0.0, -2.0}, "EPSG:32632");
  EXPECT_EQ(complaint_about(path), "no refusal");
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
  EXPECT_THAT(complaint_about(folder_.file("lost.tif")), HasSubstr("does not exist"));
  EXPECT_THAT(complaint_about(folder_.path()), HasSubstr("is a folder: give a file"));
}

}  // namespace
}  // namespace farlod
