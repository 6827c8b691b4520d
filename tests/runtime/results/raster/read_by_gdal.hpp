// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/runtime/results/raster/small_raster.hpp"

namespace farlod {

/// Of a format with a data set or a file for each band, that of the band.
[[nodiscard]] inline GDALDatasetUniquePtr dataset_of(const std::filesystem::path& path, int band = 1) {
  GDALAllRegister();
  constexpr std::array bands{"svf", "svf_low", "svf_high"};
  const std::string name = bands.at(static_cast<std::size_t>(band - 1)), ending = path.extension().string();
  const std::string file = ending == ".zip"       ? "/vsizip/" + path.string() + "/" + name + ".tif"
                           : ending == ".solweig" ? "/vsizip/" + path.string() + "/svfs.zip/" + name + ".tif"
                           : ending == ".zarr"    ? "ZARR:\"" + path.string() + "\":/" + name
                                                  : path.string();
  GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER));
  EXPECT_NE(dataset, nullptr) << path;
  if (dataset == nullptr || dataset->GetRasterCount() > 0) return dataset;
  const std::string key = "SUBDATASET_" + std::to_string(band) + "_NAME";
  const std::string part = CSLFetchNameValueDef(dataset->GetMetadata("SUBDATASETS"), key.c_str(), "");
  return GDALDatasetUniquePtr(GDALDataset::Open(part.c_str(), GDAL_OF_RASTER));
}

[[nodiscard]] inline std::vector<float> pixels_of(GDALDataset& dataset, int band = 1) {
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  std::vector<float> pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  EXPECT_EQ(dataset.GetRasterBand(dataset.GetRasterCount() == 1 ? 1 : band)
                ->RasterIO(GF_Read, 0, 0, columns, rows, pixels.data(), columns, rows, GDT_Float32, 0, 0, nullptr),
            CE_None);
  return pixels;
}

inline void expect_place_of(const WholeRaster& raster, GDALDataset& dataset) {
  EXPECT_EQ(dataset.GetRasterXSize(), static_cast<int>(raster.columns));
  EXPECT_EQ(dataset.GetRasterYSize(), static_cast<int>(raster.rows));
  std::array<double, 6> geotransform{};
  ASSERT_EQ(dataset.GetGeoTransform(geotransform.data()), CE_None);
  EXPECT_THAT(geotransform,
              testing::ElementsAre(raster.north_west_m.x, raster.step_m, 0.0, raster.north_west_m.y, 0.0, -raster.step_m));
  ASSERT_NE(dataset.GetSpatialRef(), nullptr);
  OGRSpatialReference expected;
  ASSERT_EQ(expected.importFromWkt(raster.crs_wkt.c_str()), OGRERR_NONE);
  EXPECT_TRUE(dataset.GetSpatialRef()->IsSame(&expected));
}

/// What a program prints and reports, and whether it ended well.
struct Ended {
  std::string text;
  bool is_good = false;
};
[[nodiscard]] inline Ended ended(const std::string& command) {
  Ended result;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return result;
  std::array<char, 4096> bytes{};
  for (std::size_t count = 1; count != 0;) {
    count = fread(bytes.data(), 1, bytes.size(), pipe);
    result.text.append(bytes.data(), count);
  }
  result.is_good = pclose(pipe) == 0;
  return result;
}

}  // namespace farlod
