// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <csignal>
#include <random>

#include "farlod/error.hpp"
#include "results/crs_gdal.hpp"
#include "results/raster/raster_writer_esri_ascii.hpp"
#include "results/raster/raster_writers.hpp"
#include "tests/runtime/results/raster/read_by_gdal.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

// What we write is read back by GDAL, which most of those who open our files use.

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

WholeRaster raster_with_bounds() {
  WholeRaster raster = small_raster();
  raster.bands = svf_bands("svf", RasterBands::svf_and_bounds);
  raster.low = raster.high = raster.svf;
  return raster;
}

class GeoTiff : public testing::Test {
 protected:
  /// Writes a raster, and opens what was written.
  [[nodiscard]] GDALDatasetUniquePtr written(const WholeRaster& raster) const {
    write_whole<geotiff_writer>(raster, path);
    EXPECT_THAT(folder.names(), ElementsAre("a.tif"));
    return dataset_of(path);
  }

  scenes::TemporaryFolder folder;
  std::filesystem::path path = folder.file("a.tif");
};

TEST_F(GeoTiff, LiesWhereTheRasterLies) { expect_place_of(small_raster(), *written(small_raster())); }

TEST_F(GeoTiff, HoldsTheValuesAndDeclaresNoData) {
  const auto dataset = written(small_raster());
  EXPECT_THAT(pixels_of(*dataset), testing::Pointwise(testing::NanSensitiveFloatEq(), small_raster().svf));
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  int declared = 0;
  EXPECT_TRUE(std::isnan(band.GetNoDataValue(&declared)));
  EXPECT_TRUE(declared);
  EXPECT_STREQ(band.GetDescription(), "svf");
  EXPECT_EQ(band.GetRasterDataType(), GDT_Float32);
}

/// Tiles that take long to compress before such that take no time.
WholeRaster uneven_raster(std::size_t threads) {
  WholeRaster raster = small_raster();
  raster.columns = 9 * raster_tile_edge;
  raster.rows = 3 * raster_tile_edge + 1;
  raster.threads = threads;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(0.0F, 1.0F);
  raster.svf.clear();
  for (std::size_t n = 0; n < raster.columns * raster.rows; ++n)
    raster.svf.push_back(n % raster.columns / raster_tile_edge % 3 == 0 ? any(random) : 0.5F);
  return raster;
}

TEST_F(GeoTiff, HasTheSameBytesWithAnyNumberOfThreads) {
  EXPECT_EQ(pixels_of(*written(uneven_raster(1))), uneven_raster(1).svf);
  for (const std::size_t threads : {2U, 5U, 40U}) {
    write_whole<geotiff_writer>(uneven_raster(threads), folder.file("b.tif"));
    EXPECT_TRUE(scenes::text_of(path) == scenes::text_of(folder.file("b.tif"))) << threads;
  }
}

TEST_F(GeoTiff, IsCloudOptimised) {
  const auto dataset = written(uneven_raster(2));
  EXPECT_STREQ(dataset->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
  // 2304 × 769 pixels: halved until they lie in a block
  EXPECT_EQ(dataset->GetRasterBand(1)->GetOverviewCount(), 3);
  const std::string validator = "/usr/bin/python3 -m osgeo_utils.samples.validate_cloud_optimized_geotiff ";
  if (!ended(validator + "--help").text.starts_with("usage") &&
      !ended("/usr/bin/python3 -c 'import osgeo_utils.samples'").is_good)
    GTEST_SKIP() << "the validator of GDAL is missing; it is in the package python3-gdal";
  const Ended validated = ended(validator + path.string());
  EXPECT_TRUE(validated.is_good) << validated.text;
  EXPECT_THAT(validated.text, HasSubstr("is a valid cloud optimized GeoTIFF"));
}

TEST_F(GeoTiff, OverviewsAreAveragesOfWhatHasData) {
  WholeRaster raster = uneven_raster(1);
  raster.rows -= 1;  // then each pixel of the overview is over two by two
  raster.svf.assign(raster.columns * raster.rows, 0.25F);
  raster.svf[0] = raster.svf[1] = std::nanf("");
  raster.svf[2] = 0.75F;
  for (const std::size_t row : {0U, 1U})
    for (const std::size_t column : {4U, 5U}) raster.svf[row * raster.columns + column] = std::nanf("");
  const auto dataset = written(raster);
  std::array<float, 4> first{};
  ASSERT_EQ(
      dataset->GetRasterBand(1)->GetOverview(0)->RasterIO(GF_Read, 0, 0, 4, 1, first.data(), 4, 1, GDT_Float32, 0, 0, nullptr),
      CE_None);
  EXPECT_EQ(first[0], 0.25F);
  EXPECT_EQ(first[1], 0.375F);
  EXPECT_TRUE(std::isnan(first[2]));
  EXPECT_EQ(first[3], 0.25F);
}

TEST_F(GeoTiff, SaysWhatItsBandsAreAndWhatMadeIt) {
  WholeRaster raster = raster_with_bounds();
  raster.provenance = {"Far-LoD 1", "town.farlod", "0123", "--grid 2"};
  const auto dataset = written(raster);
  ASSERT_EQ(dataset->GetRasterCount(), 3);
  for (std::size_t n = 0; n < raster.bands.size(); ++n) {
    GDALRasterBand& band = *dataset->GetRasterBand(static_cast<int>(n) + 1);
    EXPECT_EQ(band.GetDescription(), raster.bands[n].name);
    EXPECT_EQ(band.GetUnitType(), raster.bands[n].unit);
    ASSERT_NE(band.GetMetadataItem("definition"), nullptr);
    EXPECT_EQ(band.GetMetadataItem("definition"), raster.bands[n].definition);
  }
  for (const auto& [name, value] : entries_of(raster.provenance)) {
    ASSERT_NE(dataset->GetMetadataItem(name.c_str()), nullptr) << name;
    EXPECT_EQ(dataset->GetMetadataItem(name.c_str()), value);
  }
  EXPECT_THAT(dataset->GetMetadataItem("TIFFTAG_SOFTWARE"), testing::StartsWith("Far-LoD "));
  EXPECT_EQ(dataset->GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION"), raster.bands[0].definition);
}

/// While it lives, no file of the process grows beyond so many bytes.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(GeoTiff, AFullDiskIsToldWithAnyNumberOfThreads) {
  for (const std::size_t threads : {1U, 2U, 40U}) {
    const WholeRaster raster = uneven_raster(threads);
    {
      const FileSizeLimit limit(300'000);
      EXPECT_THROW(write_whole<geotiff_writer>(raster, path), OutputError) << threads;
    }
    EXPECT_THAT(folder.names(), IsEmpty()) << threads;
  }
}

TEST_F(GeoTiff, KeepsACrsWithoutACode) {
  WholeRaster raster = small_raster();
  raster.crs_wkt =
      R"(PROJCS["town",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",48.25],PARAMETER["central_meridian",11.5],PARAMETER["scale_factor",1],PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1]])";
  expect_place_of(raster, *written(raster));
}

TEST_F(GeoTiff, LeavesNothingBehindOnFailure) {
  WholeRaster raster = small_raster();
  raster.crs_wkt = "PROJCS[";
  EXPECT_THROW(write_whole<geotiff_writer>(raster, path), OutputError);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST_F(GeoTiff, NamesTheFileThatCannotBeWritten) {
  EXPECT_THAT(
      scenes::refusal_of<OutputError>([&] { write_whole<geotiff_writer>(small_raster(), folder.file("missing") / "a.tif"); }),
      HasSubstr("missing/a.tif: "));
}

TEST(EsriAscii, IsReadByGdalAsTheSameRaster) {
  const scenes::TemporaryFolder folder;
  write_whole<made<EsriAsciiWriter>>(small_raster(), folder.file("a.asc"));
  EXPECT_THAT(folder.names(), UnorderedElementsAre("a.asc", "a.prj"));
  const auto dataset = dataset_of(folder.file("a.asc"));
  ASSERT_NE(dataset, nullptr);
  expect_place_of(small_raster(), *dataset);
  EXPECT_EQ(dataset->GetRasterBand(1)->GetRasterDataType(), GDT_Float32);
  const auto nodata = static_cast<float>(dataset->GetRasterBand(1)->GetNoDataValue());
  std::vector<float> expected = small_raster().svf;
  for (float& svf : expected) svf = std::isnan(svf) ? nodata : svf;
  EXPECT_EQ(pixels_of(*dataset), expected);
}

TEST(EsriAscii, TheCrsOfAPackageIsReadByGdal) {
  const scenes::TemporaryFolder folder;
  // Packages say their CRS in WKT 2
  OGRSpatialReference crs;
  ASSERT_EQ(crs.importFromEPSG(25832), OGRERR_NONE);
  WholeRaster raster = small_raster();
  char* wkt2 = nullptr;
  constexpr std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
  ASSERT_EQ(crs.exportToWkt(&wkt2, options.data()), OGRERR_NONE);
  raster.crs_wkt = wkt2;
  CPLFree(wkt2);
  ASSERT_THAT(raster.crs_wkt, testing::StartsWith("PROJCRS["));
  raster.crs_wkt = esri_wkt_of(raster.crs_wkt);
  write_whole<made<EsriAsciiWriter>>(raster, folder.file("a.asc"));
  const auto dataset = dataset_of(folder.file("a.asc"));
  ASSERT_NE(dataset->GetSpatialRef(), nullptr);
  EXPECT_TRUE(dataset->GetSpatialRef()->IsSame(&crs));
}

TEST(EsriWkt, WhatIsNoWktComesBackAsItIs) { EXPECT_EQ(esri_wkt_of("no WKT"), "no WKT"); }

TEST(EsriAscii, OpenFieldIsNotTakenForIntegers) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.svf.assign(raster.svf.size(), 1.0F);
  write_whole<made<EsriAsciiWriter>>(raster, folder.file("a.asc"));
  EXPECT_EQ(dataset_of(folder.file("a.asc"))->GetRasterBand(1)->GetRasterDataType(), GDT_Float32);
}

TEST(EsriAscii, WithoutCrsHasNoPrj) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.crs_wkt.clear();
  write_whole<made<EsriAsciiWriter>>(raster, folder.file("a.asc"));
  EXPECT_THAT(folder.names(), ElementsAre("a.asc"));
}

TEST(ZippedGeotiffs, AreTheFilesThatTheirBandsWouldBe) {
  const scenes::TemporaryFolder folder;
  write_whole<zipped_geotiff_writer>(raster_with_bounds(), folder.file("a.zip"));
  EXPECT_THAT(folder.names(), ElementsAre("a.zip"));
  const std::string zip = scenes::text_of(folder.file("a.zip"));
  WholeRaster low = small_raster();
  low.bands = {raster_with_bounds().bands[1]};
  write_whole<geotiff_writer>(low, folder.file("svf_low.tif"));
  // Stored as it is, so that its bytes stand in the ZIP file
  EXPECT_THAT(zip, HasSubstr(scenes::text_of(folder.file("svf_low.tif"))));
}

}  // namespace
}  // namespace farlod
