// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <random>

#include "farlod/error.hpp"
#include "results/crs_gdal.hpp"
#include "results/raster/raster_writer_esri_ascii.hpp"
#include "results/raster/raster_writers.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

// What we write is read back by GDAL, which most of those who open our files use.

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

GDALDatasetUniquePtr open_raster(const std::filesystem::path& path) {
  GDALAllRegister();
  return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
}

std::vector<float> pixels_of(GDALDataset& dataset) {
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  std::vector<float> pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  EXPECT_EQ(
      dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, pixels.data(), columns, rows, GDT_Float32, 0, 0, nullptr),
      CE_None);
  return pixels;
}

void expect_place_of(const WholeRaster& raster, GDALDataset& dataset) {
  EXPECT_EQ(dataset.GetRasterXSize(), static_cast<int>(raster.columns));
  EXPECT_EQ(dataset.GetRasterYSize(), static_cast<int>(raster.rows));
  std::array<double, 6> geotransform{};
  ASSERT_EQ(dataset.GetGeoTransform(geotransform.data()), CE_None);
  EXPECT_THAT(geotransform, ElementsAre(raster.north_west_m.x, raster.step_m, 0.0, raster.north_west_m.y, 0.0, -raster.step_m));
  ASSERT_NE(dataset.GetSpatialRef(), nullptr);
  OGRSpatialReference expected;
  ASSERT_EQ(expected.importFromWkt(raster.crs_wkt.c_str()), OGRERR_NONE);
  EXPECT_TRUE(dataset.GetSpatialRef()->IsSame(&expected));
}

TEST(GeoTiff, LiesWhereTheRasterLies) {
  const scenes::TemporaryFolder folder;
  write_whole<geotiff_writer>(small_raster(), folder.file("a.tif"));
  EXPECT_THAT(folder.names(), ElementsAre("a.tif"));
  const auto dataset = open_raster(folder.file("a.tif"));
  ASSERT_NE(dataset, nullptr);
  expect_place_of(small_raster(), *dataset);
}

TEST(GeoTiff, HoldsTheValuesAndDeclaresNoData) {
  const scenes::TemporaryFolder folder;
  write_whole<geotiff_writer>(small_raster(), folder.file("a.tif"));
  const auto dataset = open_raster(folder.file("a.tif"));
  ASSERT_NE(dataset, nullptr);
  EXPECT_THAT(pixels_of(*dataset), testing::Pointwise(testing::NanSensitiveFloatEq(), small_raster().svf));
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  int declared = 0;
  EXPECT_TRUE(std::isnan(band.GetNoDataValue(&declared)));
  EXPECT_TRUE(declared);
  EXPECT_STREQ(band.GetDescription(), "svf");
  EXPECT_EQ(band.GetRasterDataType(), GDT_Float32);
}

TEST(GeoTiff, HasTheSameBytesEachTime) {
  const scenes::TemporaryFolder folder;
  write_whole<geotiff_writer>(small_raster(), folder.file("a.tif"));
  write_whole<geotiff_writer>(small_raster(), folder.file("b.tif"));
  EXPECT_EQ(scenes::text_of(folder.file("a.tif")), scenes::text_of(folder.file("b.tif")));
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

TEST(GeoTiff, HasTheSameBytesWithAnyNumberOfThreads) {
  const scenes::TemporaryFolder folder;
  write_whole<geotiff_writer>(uneven_raster(1), folder.file("a.tif"));
  const auto dataset = open_raster(folder.file("a.tif"));
  ASSERT_NE(dataset, nullptr);
  EXPECT_EQ(pixels_of(*dataset), uneven_raster(1).svf);
  for (const std::size_t threads : {2U, 5U, 40U}) {
    write_whole<geotiff_writer>(uneven_raster(threads), folder.file("b.tif"));
    EXPECT_TRUE(scenes::text_of(folder.file("a.tif")) == scenes::text_of(folder.file("b.tif"))) << threads;
  }
}

/// What a program prints and reports, and whether it ended well.
struct Ended {
  std::string text;
  bool is_good = false;
};
Ended ended(const std::string& command) {
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

TEST(GeoTiff, IsCloudOptimised) {
  const scenes::TemporaryFolder folder;
  write_whole<geotiff_writer>(uneven_raster(2), folder.file("a.tif"));
  const auto dataset = open_raster(folder.file("a.tif"));
  ASSERT_NE(dataset, nullptr);
  EXPECT_STREQ(dataset->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE"), "COG");
  // 2304 × 769 pixels: halved until they lie in a block
  EXPECT_EQ(dataset->GetRasterBand(1)->GetOverviewCount(), 3);
  const std::string validator = "/usr/bin/python3 -m osgeo_utils.samples.validate_cloud_optimized_geotiff ";
  if (!ended(validator + "--help").text.starts_with("usage") &&
      !ended("/usr/bin/python3 -c 'import osgeo_utils.samples'").is_good)
    GTEST_SKIP() << "the validator of GDAL is missing; it is in the package python3-gdal";
  const Ended validated = ended(validator + folder.file("a.tif").string());
  EXPECT_TRUE(validated.is_good) << validated.text;
  EXPECT_THAT(validated.text, HasSubstr("is a valid cloud optimized GeoTIFF"));
}

TEST(GeoTiff, OverviewsAreAveragesOfWhatHasData) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = uneven_raster(1);
  raster.rows -= 1;  // then each pixel of the overview is over two by two
  raster.svf.assign(raster.columns * raster.rows, 0.25F);
  raster.svf[0] = raster.svf[1] = std::nanf("");
  raster.svf[2] = 0.75F;
  for (const std::size_t row : {0U, 1U})
    for (const std::size_t column : {4U, 5U}) raster.svf[row * raster.columns + column] = std::nanf("");
  write_whole<geotiff_writer>(raster, folder.file("a.tif"));
  const auto dataset = open_raster(folder.file("a.tif"));
  std::array<float, 4> first{};
  ASSERT_EQ(
      dataset->GetRasterBand(1)->GetOverview(0)->RasterIO(GF_Read, 0, 0, 4, 1, first.data(), 4, 1, GDT_Float32, 0, 0, nullptr),
      CE_None);
  EXPECT_EQ(first[0], 0.25F);
  EXPECT_EQ(first[1], 0.375F);
  EXPECT_TRUE(std::isnan(first[2]));
  EXPECT_EQ(first[3], 0.25F);
}

TEST(GeoTiff, SaysWhatItsBandsAreAndWhatMadeIt) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.bands = svf_bands("svf", RasterBands::svf_and_bounds);
  raster.low = raster.high = raster.svf;
  raster.provenance = {"Far-LoD 1", "town.farlod", "0123", "--grid 2"};
  write_whole<geotiff_writer>(raster, folder.file("a.tif"));
  const auto dataset = open_raster(folder.file("a.tif"));
  ASSERT_NE(dataset, nullptr);
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

TEST(GeoTiff, AFullDiskIsToldWithAnyNumberOfThreads) {
  for (const std::size_t threads : {1U, 2U, 40U}) {
    const scenes::TemporaryFolder folder;
    const WholeRaster raster = uneven_raster(threads);
    {
      const FileSizeLimit limit(300'000);
      EXPECT_THROW(write_whole<geotiff_writer>(raster, folder.file("a.tif")), OutputError) << threads;
    }
    EXPECT_THAT(folder.names(), IsEmpty()) << threads;
  }
}

TEST(GeoTiff, KeepsACrsWithoutACode) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.crs_wkt =
      R"(PROJCS["town",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",48.25],PARAMETER["central_meridian",11.5],PARAMETER["scale_factor",1],PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1]])";
  write_whole<geotiff_writer>(raster, folder.file("a.tif"));
  EXPECT_THAT(folder.names(), ElementsAre("a.tif"));
  expect_place_of(raster, *open_raster(folder.file("a.tif")));
}

TEST(GeoTiff, LeavesNothingBehindOnFailure) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.crs_wkt = "PROJCS[";
  EXPECT_THROW(write_whole<geotiff_writer>(raster, folder.file("a.tif")), OutputError);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(GeoTiff, NamesTheFileThatCannotBeWritten) {
  const scenes::TemporaryFolder folder;
  EXPECT_THAT(
      scenes::refusal_of<OutputError>([&] { write_whole<geotiff_writer>(small_raster(), folder.file("missing") / "a.tif"); }),
      HasSubstr("missing/a.tif: "));
}

TEST(EsriAscii, IsReadByGdalAsTheSameRaster) {
  const scenes::TemporaryFolder folder;
  write_whole<made<EsriAsciiWriter>>(small_raster(), folder.file("a.asc"));
  EXPECT_THAT(folder.names(), UnorderedElementsAre("a.asc", "a.prj"));
  const auto dataset = open_raster(folder.file("a.asc"));
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
  const auto dataset = open_raster(folder.file("a.asc"));
  ASSERT_NE(dataset->GetSpatialRef(), nullptr);
  EXPECT_TRUE(dataset->GetSpatialRef()->IsSame(&crs));
}

TEST(EsriWkt, WhatIsNoWktComesBackAsItIs) { EXPECT_EQ(esri_wkt_of("no WKT"), "no WKT"); }

TEST(EsriAscii, OpenFieldIsNotTakenForIntegers) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.svf.assign(raster.svf.size(), 1.0F);
  write_whole<made<EsriAsciiWriter>>(raster, folder.file("a.asc"));
  EXPECT_EQ(open_raster(folder.file("a.asc"))->GetRasterBand(1)->GetRasterDataType(), GDT_Float32);
}

TEST(EsriAscii, WithoutCrsHasNoPrj) {
  const scenes::TemporaryFolder folder;
  WholeRaster raster = small_raster();
  raster.crs_wkt.clear();
  write_whole<made<EsriAsciiWriter>>(raster, folder.file("a.asc"));
  EXPECT_THAT(folder.names(), ElementsAre("a.asc"));
}

WholeRaster raster_with_bounds() {
  WholeRaster raster = small_raster();
  raster.bands = svf_bands("svf", RasterBands::svf_and_bounds);
  raster.low = raster.high = raster.svf;
  return raster;
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

TEST(ZippedGeotiffs, HaveTheSameBytesEachTime) {
  const scenes::TemporaryFolder folder;
  write_whole<zipped_geotiff_writer>(raster_with_bounds(), folder.file("a.zip"));
  write_whole<zipped_geotiff_writer>(raster_with_bounds(), folder.file("b.zip"));
  EXPECT_EQ(scenes::text_of(folder.file("a.zip")), scenes::text_of(folder.file("b.zip")));
}

TEST(ZippedGeotiffs, LeaveNothingOfAFileThatIsGivenUp) {
  const scenes::TemporaryFolder folder;
  {
    const auto writer = zipped_geotiff_writer(raster_with_bounds(), folder.file("a.zip"));
    writer->write(tile_of(raster_with_bounds(), {0, 0}));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace farlod
