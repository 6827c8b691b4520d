// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/local_data_gdal.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <string>

#include "farlod/error.hpp"
#include "gdal/gdal_errors.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class LocalData : public testing::Test {
 protected:
  const scenes::TemporaryFolder own;
  const fs::path& folder = own.path();

  void SetUp() override {
    fs::create_directories(folder / "tiles");
    write("tiles/a.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2\n3 4\n");
    write(
        "town.geojson",
        R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[9,48]}}]})");
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }
  /// A mosaic of one tile.
  fs::path mosaic(const std::string& source, const std::string& name = "mosaic.vrt") const {
    return write(name, R"(<VRTDataset rasterXSize="2" rasterYSize="2"><GeoTransform>0,10,0,20,0,-10</GeoTransform>)"
                       R"(<VRTRasterBand dataType="Float32" band="1"><SimpleSource>)" +
                           source + "</SimpleSource></VRTRasterBand></VRTDataset>");
  }
  static std::string file_name(const std::string& text) {
    return R"(<SourceFilename relativeToVRT="1">)" + text + "</SourceFilename>";
  }
  static bool opens(const fs::path& file, unsigned int kind = GDAL_OF_RASTER, GdalReach reach = GdalReach::local_files) {
    const GdalErrors quiet;
    return open_within(reach, file, kind) != nullptr;
  }
  static std::string refusal(const fs::path& file, unsigned int kind = GDAL_OF_RASTER) {
    const GdalErrors quiet;
    try {
      (void)open_within(GdalReach::local_files, file, kind);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(LocalData, AMosaicThatIsNamedReadsItsTiles) {
  const fs::path file = mosaic(file_name("tiles/a.asc"));
  const GDALDatasetUniquePtr dataset = open_within(GdalReach::local_files, file, GDAL_OF_RASTER);
  ASSERT_NE(dataset, nullptr);
  float first = 0.0F;
  ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 1, 1, &first, 1, 1, GDT_Float32, 0, 0, nullptr), CE_None);
  EXPECT_EQ(first, 1.0F);
  EXPECT_TRUE(opens(mosaic("<SourceFilename>" + (folder / "tiles/a.asc").string() + "</SourceFilename>", "absolute.vrt")));
  EXPECT_TRUE(opens(mosaic(file_name("absolute.vrt"), "of_a_mosaic.vrt")));
}

TEST_F(LocalData, AFileThatIsFoundReadsItselfAlone) {
  EXPECT_TRUE(opens(folder / "tiles/a.asc", GDAL_OF_RASTER, GdalReach::own_data));
  EXPECT_TRUE(opens(folder / "town.geojson", GDAL_OF_VECTOR, GdalReach::own_data));
  const fs::path file = mosaic(file_name("tiles/a.asc"));
  EXPECT_FALSE(opens(file, GDAL_OF_RASTER, GdalReach::own_data));
  EXPECT_FALSE(is_known_within(GdalReach::own_data, file, GDAL_OF_RASTER));
  EXPECT_TRUE(is_known_within(GdalReach::local_files, file, GDAL_OF_RASTER));
}

TEST_F(LocalData, NothingLeadsToTheNetworkOrIntoMemory) {
  for (const char* source :
       {"/vsicurl/http://127.0.0.1:9/a.tif", "http://127.0.0.1:9/a.tif", "/vsizip//vsicurl/http://127.0.0.1:9/a.zip/a.tif",
        "/VSIS3/bucket/a.tif", "/vsis3_streaming/bucket/a.tif"})
    EXPECT_THAT(refusal(mosaic(file_name(source))), HasSubstr("beyond this computer")) << source;
  for (const char* source :
       {"MEM:::DATAPOINTER=4096,PIXELS=2,LINES=2", "&lt;GDAL_WMS&gt;&lt;/GDAL_WMS&gt;", "PG:dbname=town", "tiles/none.asc"})
    EXPECT_THAT(refusal(mosaic(file_name(source))), HasSubstr("no file on this computer")) << source;
  const fs::path service = write("service.xml", "<GDAL_WMS><Service name=\"TMS\"/></GDAL_WMS>");
  EXPECT_THAT(refusal(mosaic(file_name("service.xml"))), HasSubstr("holds no data"));
  EXPECT_FALSE(opens(service));
  EXPECT_THAT(refusal("/vsicurl/http://127.0.0.1:9/a.tif"), HasSubstr("beyond this computer: download it first"));
}

TEST_F(LocalData, NamesAreFoundWhereverTheyAre) {
  EXPECT_THAT(refusal(mosaic(R"(<a SourceFilename="/vsicurl/http://127.0.0.1:9/a.tif"/>)")), HasSubstr("beyond this computer"));
  EXPECT_THAT(refusal(mosaic("<sourcefilename>/vsigs/a.tif</sourcefilename>")), HasSubstr("beyond this computer"));
  EXPECT_THAT(refusal(mosaic(file_name("inner.vrt"), "outer.vrt")), HasSubstr("no file"));
  (void)mosaic(file_name("/vsicurl/http://127.0.0.1:9/a.tif"), "inner.vrt");
  EXPECT_THAT(refusal(folder / "outer.vrt"), HasSubstr("inner.vrt names /vsicurl"));
  EXPECT_THAT(refusal(mosaic(file_name("tiles/a.asc") + R"(<Metadata><MDI key="OVERVIEW_FILE">/vsis3/a</MDI></Metadata>)")),
              HasSubstr("beyond this computer"));
}

TEST_F(LocalData, AMosaicOfItselfEnds) { EXPECT_EQ(refusal(mosaic(file_name("mosaic.vrt"))), ""); }

TEST_F(LocalData, NoCodeAndNoQueryIsRun) {
  EXPECT_THAT(refusal(mosaic(file_name("tiles/a.asc") + "<PixelFunctionLanguage>Python</PixelFunctionLanguage>")),
              HasSubstr("PixelFunctionLanguage"));
  const auto layer = [this](const std::string& what) {
    return write("layer.vrt", R"(<OGRVRTDataSource><OGRVRTLayer name="town">)" + what + "</OGRVRTLayer></OGRVRTDataSource>");
  };
  const std::string source = R"(<SrcDataSource relativeToVRT="1">town.geojson</SrcDataSource>)";
  EXPECT_TRUE(opens(layer(source), GDAL_OF_VECTOR));
  EXPECT_THAT(refusal(layer(source + "<SrcSQL>SELECT * FROM 'http://127.0.0.1:9/'.town</SrcSQL>"), GDAL_OF_VECTOR),
              HasSubstr("SrcSQL"));
  EXPECT_THAT(refusal(layer("<SrcDataSource>WFS:http://127.0.0.1:9/</SrcDataSource>"), GDAL_OF_VECTOR),
              HasSubstr("beyond this computer"));
}

TEST_F(LocalData, OverviewsAreBesideTheirRaster) {
  (void)write(
      "tiles/a.asc.aux.xml",
      R"(<PAMDataset><Metadata domain="OVERVIEWS"><MDI key="OVERVIEW_FILE">/vsicurl/http://127.0.0.1:9/a</MDI></Metadata></PAMDataset>)");
  EXPECT_THAT(refusal(folder / "tiles/a.asc"), HasSubstr("names another file as its overviews"));
}

TEST_F(LocalData, ATableOfTablesIsOneOnlyByName) {
  const fs::path table = write("seamless.tab",
                               "!table\n!version 700\n!charset Neutral\n\nDefinition Table\n  Type NATIVE Charset \"Neutral\"\n"
                               "  Fields 1\n    Table Char (9) ;\nbegin_metadata\n\"\\IsSeamless\" = \"TRUE\"\nend_metadata\n");
  const GdalErrors quiet;
  EXPECT_THROW((void)open_within(GdalReach::own_data, table, GDAL_OF_VECTOR), InputError);
}

}  // namespace
}  // namespace farlod
