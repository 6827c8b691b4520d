// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/output_format.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <limits>

#include "farlod/error.hpp"
#include "results/picture/raster_preview.hpp"
#include "results/provenance.hpp"
#include "results/value_text.hpp"
#include "tests/counted/held_memory.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::string_view name_of(const std::filesystem::path& path) {
  const OutputFormat* format = output_format_of(path);
  return format == nullptr ? "none" : format->name;
}

TEST(OutputFormat, FollowsTheEndingInAnyCase) {
  EXPECT_EQ(name_of("out/a.csv"), "CSV");
  EXPECT_EQ(name_of("A.CSV"), "CSV");
  EXPECT_EQ(name_of("a.b.Png"), "PNG");
  EXPECT_EQ(name_of("a.SVG"), "SVG");
  EXPECT_EQ(name_of("a.pdf"), "PDF");
  EXPECT_EQ(name_of("a.asc"), "ESRI ASCII grid");
  EXPECT_EQ(name_of("a.PLY"), "PLY");
}

TEST(OutputFormat, UnknownEndingsHaveNone) {
  for (const char* path : {"a", "a.csv.gz", "a.", "csv", "folder.csv/a", ""}) EXPECT_EQ(name_of(path), "none") << path;
}

TEST(OutputFormat, TheseAreAllEndings) {
#ifdef FARLOD_WITH_GDAL
  const std::string expected =
      ".tif, .tiff, .nc, .zarr, .zip, .solweig, .csv, .gpkg, .geojson, .fgb, .ply, .glb, .png, .svg, .pdf, .asc";
#else
  const std::string expected = ".csv, .ply, .glb, .png, .svg, .pdf, .asc";
#endif
  EXPECT_EQ(endings_where([](const OutputFormat&) { return true; }), expected);
}

TEST(OutputFormat, SomeNeedGdal) {
  const std::vector<std::pair<const char*, const char*>> names{{"a.tif", "GeoTIFF"},     {"a.TIFF", "GeoTIFF"},
                                                               {"a.nc", "netCDF"},       {"a.gpkg", "GeoPackage"},
                                                               {"a.geojson", "GeoJSON"}, {"a.fgb", "FlatGeobuf"}};
  for (const auto& [path, name] : names) {
#ifdef FARLOD_WITH_GDAL
    EXPECT_EQ(name_of(path), name);
#else
    EXPECT_EQ(name_of(path), "none") << name;
#endif
  }
}

/// One row of tiles and a pixel.
WholeRaster raster_with_bounds() {
  WholeRaster raster;
  raster.columns = 2 * raster_tile_edge;
  raster.rows = raster_tile_edge + 1;
  raster.bands = svf_bands("svf", RasterBands::svf_and_bounds);
  raster.svf.assign(raster.columns * raster.rows, 0.5F);
  raster.low = raster.high = raster.svf;
  return raster;
}

std::filesystem::path output_of(const OutputFormat& format, const scenes::TemporaryFolder& folder) {
  return folder.file("a" + std::string(format.endings[0]));
}

std::string pixels_file(const OutputFormat& format, const WholeRaster& raster, const scenes::TemporaryFolder& folder) {
  {
    const auto writer = format.raster_writer(raster, output_of(format, folder));
    for (const RasterTile& tile : tiles_of(raster)) writer->write(tile);
    writer->commit();
  }
  return scenes::text_of(output_of(format, folder));
}

/// Writes all files of a format: where it holds tables, those of --surfaces.
void write_files(const OutputFormat& format, const scenes::TemporaryFolder& folder) {
  const std::filesystem::path path = output_of(format, folder);
  if (!format.holds_tables()) {
    WholeRaster raster = raster_with_bounds();
    raster.crs_wkt = small_raster().crs_wkt;
    (void)pixels_file(format, raster, folder);
    return;
  }
  EXPECT_EQ(format.surface_tables_writer({{"svf", BoundsColumns::yes}}, path)->commit({}, {}).front(), path) << format.name;
}

TEST(OutputFormat, EachWritesAFileOfItsEnding) {
  for (const OutputFormat& format : output_formats()) {
    const scenes::TemporaryFolder folder;
    write_files(format, folder);
    EXPECT_NE(scenes::text_of(output_of(format, folder)), "") << format.name;
    if (!format.holds_tables()) continue;
    const std::filesystem::path points = folder.file("points" + std::string(format.endings[0]));
    format.write_points({1, [](std::size_t) { return PointRow{}; }, nullptr, false}, {{"svf", BoundsColumns::yes}}, points);
    EXPECT_NE(scenes::text_of(points), "") << format.name;
  }
}

TEST(OutputFormat, OfSeveralFilesTheOneOfTheOutputAppearsLast) {
  for (const OutputFormat& format : output_formats()) {
    const scenes::TemporaryFolder whole;
    write_files(format, whole);
    for (const std::string& name : whole.names()) {
      if (name == output_of(format, whole).filename()) continue;
      const scenes::TemporaryFolder folder;
      // A file cannot replace a folder that holds something
      std::filesystem::create_directories(folder.file(name) / "inside");
      EXPECT_THROW(write_files(format, folder), OutputError) << name;
      EXPECT_FALSE(std::filesystem::exists(output_of(format, folder))) << format.name << " without " << name;
    }
  }
}

TEST(OutputFormat, ARasterThatHoldsBoundsWritesThem) {
  const scenes::TemporaryFolder folder;
  for (const OutputFormat& format : output_formats()) {
    if (format.raster_writer == nullptr) continue;
    WholeRaster raster = raster_with_bounds();
    const std::string before = pixels_file(format, raster, folder);
    raster.low[0] = 0.25F;
    EXPECT_EQ(pixels_file(format, raster, folder) != before, format.holds_bounds) << format.name;
  }
}

TEST(OutputFormat, WritersSayWhatTheyHold) {
  // A tile with bounds, and the buffers of streams and libraries
  constexpr std::size_t beside = 3 * raster_tile_edge * raster_tile_edge * sizeof(float) + 65536;
  RasterFrame frame = raster_with_bounds();
  frame.columns = frame.rows = longest_preview_edge / raster_tile_edge * raster_tile_edge;
  RasterTile tile({}, RasterBands::svf_and_bounds);
  for (auto* band : {&tile.svf, &tile.low, &tile.high}) band->assign(band->size(), 0.5F);
  for (const OutputFormat& format : output_formats()) {
    if (format.raster_writer == nullptr) continue;
    const scenes::TemporaryFolder folder;
    // Drivers and fonts that libraries keep once they have them
    (void)pixels_file(format, raster_with_bounds(), folder);
    const HeldMemory held;
    const auto writer = format.raster_writer(frame, output_of(format, folder));
    for (tile.place.row = 0; tile.place.row < tiles_along(frame.rows); ++tile.place.row)
      for (tile.place.column = 0; tile.place.column < tiles_along(frame.columns); ++tile.place.column) writer->write(tile);
    writer->commit();
    const std::uint64_t said = format.raster_writer_bytes(frame);
    EXPECT_LE(held.most_bytes(), said + beside) << format.name;
    // A limit that has room for the run must not refuse it
    if (HeldMemory::counts_malloc) {
      EXPECT_LE(said, held.most_bytes() + held.most_bytes() / 2) << format.name;
    }
  }
}

TEST(Xxh3OfFile, IsThatOfItsBytes) {
  const scenes::TemporaryFolder folder;
  std::ofstream(folder.file("empty"));
  // The test vector of xxHash for no bytes
  EXPECT_EQ(xxh3_of_file(folder.file("empty")), "2d06800538d394c2");
  // Longer than what is read at a time
  std::ofstream(folder.file("a")) << std::string(200'000, 'a');
  std::ofstream(folder.file("b")) << std::string(199'999, 'a') << 'b';
  EXPECT_EQ(xxh3_of_file(folder.file("a")).size(), 16U);
  EXPECT_NE(xxh3_of_file(folder.file("a")), xxh3_of_file(folder.file("b")));
}

TEST(Xxh3OfFile, IsEmptyOfNoFile) {
  const scenes::TemporaryFolder folder;
  EXPECT_EQ(xxh3_of_file(folder.file("missing")), "");
}

TEST(EntriesOf, LeavesOutWhatIsEmpty) {
  EXPECT_THAT(entries_of({"Far-LoD 1", "town.farlod", "0123", "--grid 1"}),
              ElementsAre(Pair("software", "Far-LoD 1"), Pair("package", "town.farlod"), Pair("package_manifest_xxh3", "0123"),
                          Pair("settings", "--grid 1")));
  EXPECT_THAT(entries_of({"Far-LoD 1", "", "", ""}), ElementsAre(Pair("software", "Far-LoD 1")));
}

std::string millimetre_decimal(double value) {
  std::string text;
  append_millimetres(text, value);
  return text;
}

TEST(Decimal, ShortestReadsBackAsTheSame) {
  for (const double value : {0.1, 1.0 / 3.0, 5700010.123456789, -1e-7, 1e22, std::numeric_limits<double>::denorm_min()})
    EXPECT_EQ(std::strtod(shortest_decimal(value).c_str(), nullptr), value);
  EXPECT_EQ(shortest_decimal(0.1F), "0.1");
}

TEST(Decimal, HasNoExponentAndNoNegativeZero) {
  EXPECT_EQ(shortest_decimal(1e6), "1000000");
  EXPECT_EQ(shortest_decimal(-0.0), "0");
  EXPECT_EQ(millimetre_decimal(-0.0001), "0");
}

TEST(Decimal, LongestNumbersFit) {
  EXPECT_EQ(shortest_decimal(std::numeric_limits<double>::max()).size(), 309U);
  EXPECT_EQ(shortest_decimal(-std::numeric_limits<double>::denorm_min()).size(), 327U);
}

TEST(Decimal, CoordinatesEndAtTheMillimetre) {
  EXPECT_EQ(millimetre_decimal(5700010.123456), "5700010.123");
  EXPECT_EQ(millimetre_decimal(1.5), "1.5");
  EXPECT_EQ(millimetre_decimal(2.0), "2");
  EXPECT_EQ(millimetre_decimal(-0.05), "-0.05");
  EXPECT_EQ(millimetre_decimal(-12.345678), "-12.346");
  EXPECT_EQ(millimetre_decimal(999999999999.9995), "1000000000000");
  EXPECT_EQ(millimetre_decimal(1e15 + 0.25), "1000000000000000.2");
  EXPECT_EQ(millimetre_decimal(0.001), "0.001");
}

TEST(Decimal, SharesHaveSixDigits) {
  EXPECT_EQ(svf_decimal(1.0), "1.000000");
  EXPECT_EQ(svf_decimal(0.3390174), "0.339017");
}

}  // namespace
}  // namespace farlod
