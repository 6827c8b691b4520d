// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writers.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "farlod/error.hpp"
#include "results/crs_gdal.hpp"
#include "tests/runtime/results/raster/read_by_gdal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

WholeRaster described_raster() {
  WholeRaster raster = small_raster();
  raster.epsg = 25832;
  raster.provenance = {"Far-LoD 1", "town.farlod", "0123", "--grid 2"};
  return raster;
}

TEST(Netcdf, HasTheAttributesOfTheConventions) {
  const scenes::TemporaryFolder folder;
  write_whole<netcdf_writer>(described_raster(), folder.file("a.nc"));
  EXPECT_THAT(folder.names(), ElementsAre("a.nc"));
  if (ended("command -v ncdump").text.empty()) GTEST_SKIP() << "ncdump is missing; it is in the package netcdf-bin";
  const std::string header = ended("ncdump -h '" + folder.file("a.nc").string() + "'").text;
  for (const char* line : {"y = 3 ;",
                           "x = 5 ;",
                           "double y(y) ;",
                           "double x(x) ;",
                           R"(y:standard_name = "projection_y_coordinate" ;)",
                           R"(x:standard_name = "projection_x_coordinate" ;)",
                           R"(x:units = "m" ;)",
                           R"(y:axis = "Y" ;)",
                           "int crs ;",
                           R"(crs:grid_mapping_name = "transverse_mercator" ;)",
                           "crs:scale_factor_at_central_meridian = 0.9996 ;",
                           "crs:longitude_of_central_meridian = 9. ;",
                           "crs:latitude_of_projection_origin = 0. ;",
                           "crs:false_easting = 500000. ;",
                           "crs:false_northing = 0. ;",
                           "crs:semi_major_axis = 6378137. ;",
                           "crs:inverse_flattening = 298.257222101 ;",
                           "crs:crs_wkt = ",
                           "float svf(y, x) ;",
                           R"(svf:units = "1" ;)",
                           R"(svf:long_name = "sky view factor)",
                           R"(svf:grid_mapping = "crs" ;)",
                           "svf:_FillValue = NaNf ;",
                           R"(:Conventions = "CF-1.8" ;)",
                           R"(:title = "sky view factor)",
                           R"(:source = "Far-LoD 1" ;)",
                           R"(:package = "town.farlod" ;)",
                           R"(:package_manifest_xxh3 = "0123" ;)",
                           R"(:settings = "--grid 2" ;)"})
    EXPECT_THAT(header, HasSubstr(line));
}

TEST(Netcdf, LiesWhereTheRasterLies) {
  const scenes::TemporaryFolder folder;
  write_whole<netcdf_writer>(described_raster(), folder.file("a.nc"));
  const GDALDatasetUniquePtr dataset = dataset_of(folder.file("a.nc"));
  expect_place_of(described_raster(), *dataset);
  EXPECT_THAT(pixels_of(*dataset), testing::Pointwise(testing::NanSensitiveFloatEq(), described_raster().svf));
  EXPECT_TRUE(std::isnan(dataset->GetRasterBand(1)->GetNoDataValue()));
  EXPECT_STREQ(dataset->GetRasterBand(1)->GetUnitType(), "1");
}

TEST(Netcdf, AFolderThatDoesNotExistIsTold) {
  const scenes::TemporaryFolder folder;
  EXPECT_THROW(write_whole<netcdf_writer>(small_raster(), folder.file("missing") / "a.nc"), OutputError);
}

CfGridMapping mapping_of(int epsg) {
  OGRSpatialReference crs;
  EXPECT_EQ(crs.importFromEPSG(epsg), OGRERR_NONE);
  char* wkt = nullptr;
  EXPECT_EQ(crs.exportToWkt(&wkt), OGRERR_NONE);
  const std::string text = wkt;
  CPLFree(wkt);
  return cf_grid_mapping_of(text, std::nullopt);
}

TEST(CfGridMapping, KnowsOtherProjections) {
  const CfGridMapping france = mapping_of(2154);
  EXPECT_EQ(france.name, "lambert_conformal_conic");
  EXPECT_THAT(france.parameters, testing::IsSupersetOf({Pair("standard_parallel", std::vector{49.0, 44.0}),
                                                        Pair("longitude_of_central_meridian", std::vector{3.0}),
                                                        Pair("latitude_of_projection_origin", std::vector{46.5})}));
  const CfGridMapping europe = mapping_of(3035);
  EXPECT_EQ(europe.name, "lambert_azimuthal_equal_area");
  EXPECT_THAT(europe.parameters, testing::IsSupersetOf({Pair("latitude_of_projection_origin", std::vector{52.0}),
                                                        Pair("longitude_of_projection_origin", std::vector{10.0})}));
  EXPECT_EQ(mapping_of(5070).name, "albers_conical_equal_area");
  EXPECT_THAT(mapping_of(5070).parameters, testing::Contains(Pair("latitude_of_projection_origin", std::vector{23.0})));
}

TEST(CfGridMapping, TellsTheEllipsoidOfOthers) {
  // An oblique stereographic projection, for which the conventions have no word
  const CfGridMapping netherlands = mapping_of(28992);
  EXPECT_EQ(netherlands.name, "");
  EXPECT_THAT(netherlands.parameters, testing::Contains(Pair("semi_major_axis", std::vector{6377397.155})));
}

}  // namespace
}  // namespace farlod
