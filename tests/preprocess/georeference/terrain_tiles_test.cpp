// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"
#include "georeference/raster_reader.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

class TerrainTiles : public testing::Test {
 protected:
  void SetUp() override { GDALAllRegister(); }

  /// Two columns and two rows, the north row first.
  [[nodiscard]] TerrainFile tile(const std::string& name, double x, double cell, const std::string& values) const {
    std::ofstream(folder.file(name)) << "ncols 2\nnrows 2\nxllcorner " << x << "\nyllcorner 0\ncellsize " << cell
                                     << "\nNODATA_value -9999\n"
                                     << values;
    return folder.file(name);
  }
  [[nodiscard]] TerrainRaster read(const std::vector<TerrainFile>& files, std::optional<Box2d> wanted = {}) {
    return read_terrain(std::span(files), "", georeference_around({0.0, 0.0}, *Crs::find("EPSG:25832")), wanted, report);
  }

  const scenes::TemporaryFolder folder;
  Report report;
};

TEST_F(TerrainTiles, BesideEachOtherAreOneTerrain) {
  const TerrainRaster terrain = read({tile("a.asc", 0.0, 10.0, "3 4\n1 2\n"), tile("b.asc", 20.0, 10.0, "7 8\n5 6\n")});
  EXPECT_EQ(terrain.columns, 4U);
  EXPECT_EQ(terrain.rows, 2U);
  EXPECT_EQ(terrain.first, (Point2d{5.0, 5.0}));
  EXPECT_THAT(terrain.height_m, ElementsAre(Optional(1.0F), Optional(2.0F), Optional(5.0F), Optional(6.0F), Optional(3.0F),
                                            Optional(4.0F), Optional(7.0F), Optional(8.0F)));
}

TEST_F(TerrainTiles, LaterOnesLieOnTopButForTheirNoData) {
  const TerrainFile below = tile("below.asc", 0.0, 10.0, "3 4\n1 2\n"), above = tile("above.asc", 10.0, 10.0, "-9999 8\n5 6\n");
  EXPECT_THAT(read({below, above}).height_m,
              ElementsAre(Optional(1.0F), Optional(5.0F), Optional(6.0F), Optional(3.0F), Optional(4.0F), Optional(8.0F)));
  EXPECT_THAT(read({above, below}).height_m[1], Optional(2.0F));
}

TEST_F(TerrainTiles, AreAsFineAsTheFinest) {
  const TerrainRaster terrain =
      read({tile("coarse.asc", 0.0, 20.0, "10 20\n10 20\n"), tile("fine.asc", 60.0, 10.0, "9 9\n9 9\n")});
  EXPECT_EQ(terrain.step_m, (Point2d{10.0, 10.0}));
  // Nodes lie at 5, 15, 25 … m: those of the coarse tile, at 10 and 30 m, are met in between alone
  EXPECT_THAT(terrain.height_at({15.0, 15.0}), Optional(12.5));
  EXPECT_THAT(terrain.height_m[terrain.columns - 1], Optional(9.0F));
}

TEST_F(TerrainTiles, MayLieElsewhereButNotAll) {
  const TerrainFile here = tile("here.asc", 0.0, 10.0, "1 1\n1 1\n"), there = tile("there.asc", 1000.0, 10.0, "2 2\n2 2\n");
  const Box2d wanted{{2.0, 2.0}, {18.0, 18.0}};
  const TerrainRaster terrain = read({there, here}, wanted);
  EXPECT_EQ(terrain.columns, 2U);
  EXPECT_THAT(terrain.height_m, Each(Optional(1.0F)));
  EXPECT_THAT(scenes::refusal_of<InputError>([&] {
                (void)read({there, there}, wanted);
              }),
              AllOf(HasSubstr("none of the 2 files of --terrain meets the city: the first, "),
                    HasSubstr("there.asc does not meet the city: it lies from 1000, 0 to 1020, 20 in ETRS89 / UTM zone 32N")));
}

/// Nine rows of the same two numbers.
std::string rows_of(const std::string& numbers) {
  std::string rows;
  for (int n = 0; n < 9; ++n) rows += numbers + "\n";
  return rows;
}

class TallTiles : public TerrainTiles {
 protected:
  [[nodiscard]] TerrainFile tall(const std::string& name, double x, const std::string& numbers) const {
    std::ofstream(folder.file(name)) << "ncols 2\nnrows 9\nxllcorner " << x << "\nyllcorner 0\ncellsize 10\n" << rows_of(numbers);
    return folder.file(name);
  }
  /// But for where the tiles lie.
  [[nodiscard]] std::string told() const {
    std::string text;
    for (const Problem& problem : report.problems())
      if (problem.code != ProblemCode::unlikely_place)
        text += std::filesystem::path(problem.source).filename().string() + " " + std::to_string(static_cast<int>(problem.code)) +
                ": " + problem.detail + "\n";
    return text;
  }
};

TEST_F(TallTiles, ThatDoNotAgreeAreTold) {
  (void)read({tall("a.asc", 0.0, "500 501"), tall("b.asc", 20.0, "502 503")});
  EXPECT_EQ(told(), "");
  (void)read({tall("a.asc", 0.0, "500 501"), tall("b.asc", 20.0, "510 511")});
  EXPECT_THAT(told(), testing::MatchesRegex("b.asc 212: where it meets .*a.asc, it is 8.0 m above that: .*\n"));
  EXPECT_THAT(scenes::refusal_of<InputError>([&] {
                (void)read({tall("a.asc", 0.0, "500 501"), tall("b.asc", 20.0, "456 457")});
              }),
              HasSubstr("it is 46.0 m below that"));
}

TEST_F(TallTiles, OfNothingButZerosAreNoGround) {
  const TerrainRaster terrain = read({tall("a.asc", 0.0, "500 501"), tall("b.asc", 20.0, "0 0")});
  EXPECT_THAT(told(), testing::StartsWith("b.asc 211: it holds one number alone"));
  EXPECT_THAT(terrain.height_m[1], Optional(501.0F));
  EXPECT_EQ(terrain.height_m[2], std::nullopt);
}

/// Pixels of 2 m, turned by the angle of a triangle 3 : 4 : 5. A wall of 10 m stands between the first two columns and the rest.
/// A raster of 1 km near Munich that says its CRS is UTM 32N.
class RasterOfMunich : public TerrainTiles {
 protected:
  void SetUp() override {
    TerrainTiles::SetUp();
    (void)tile("munich.asc", 0.0, 1000.0, "500 510\n520 530\n");
    std::ofstream(folder.file("munich.vrt"))
        << R"(<VRTDataset rasterXSize="2" rasterYSize="2"><SRS>EPSG:25832</SRS>)"
        << R"(<GeoTransform>690000, 1000, 0, 5336000, 0, -1000</GeoTransform>)"
        << R"(<VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="1">munich.asc)"
        << "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
    files = {folder.file("munich.vrt")};
  }
  /// The code of the city's CRS, with these settings.
  int code_with(const GeoreferenceSettings& settings) {
    take_crs_of_inputs(files, settings, report);
    const Georeference frame = georeference_of_terrain(files, settings, report);
    (void)read_terrain(std::span<const TerrainFile>(files), settings.crs, frame, std::nullopt, report);
    return frame.epsg.value_or(0);
  }
  [[nodiscard]] std::vector<ProblemCode> codes() const {
    std::vector<ProblemCode> found;
    for (const Problem& problem : report.problems()) found.push_back(problem.code);
    return found;
  }
  std::vector<TerrainFile> files;
};

/// --crs was ignored without a word.
TEST_F(RasterOfMunich, HasTheCrsOfTheOptionAsFootprintsHave) {
  EXPECT_EQ(code_with({"EPSG:25833", ""}), 25833);
  EXPECT_THAT(codes(), ElementsAre(ProblemCode::two_crs));
  EXPECT_THAT(report.problems()[0].detail, AllOf(HasSubstr("the file says EPSG:25832"), HasSubstr("--crs says EPSG:25833")));
}

TEST_F(RasterOfMunich, IsDoubtedWhereTheCrsIsNotMeantForIt) {
  (void)code_with({"EPSG:25835", ""});
  EXPECT_THAT(codes(), ElementsAre(ProblemCode::two_crs, ProblemCode::unlikely_place)) << "its area ends north of Munich";
  EXPECT_THAT(report.problems()[1].detail, HasSubstr("ETRS89 / UTM zone 35N is not meant to be used"));
}

TEST_F(RasterOfMunich, IsDoubtedFarFromTheCountryOfTheCrs) {
  (void)code_with({"EPSG:28992", ""});
  EXPECT_THAT(codes(), ElementsAre(ProblemCode::two_crs, ProblemCode::unlikely_place));
  EXPECT_THAT(report.problems()[1].detail, HasSubstr("Amersfoort / RD New (Netherlands) is not meant to be used"));
}

TEST_F(RasterOfMunich, KeepsItsOwnCrsWhereTheOptionIsForDegrees) {
  EXPECT_EQ(code_with({"EPSG:4326", ""}), 25832);
  EXPECT_THAT(codes(), ElementsAre(ProblemCode::two_crs));
  EXPECT_THAT(report.problems()[0].detail, HasSubstr("which is used"));
}

TEST_F(RasterOfMunich, IsDoubtedInAnOutputCrsOfElsewhere) {
  EXPECT_EQ(code_with({"", "EPSG:2056"}), 2056);
  EXPECT_THAT(codes(), ElementsAre(ProblemCode::unlikely_place));
}

TEST_F(RasterOfMunich, TellsNothingOfItsOwnCrs) {
  EXPECT_EQ(code_with({"EPSG:25832", ""}), 25832);
  EXPECT_EQ(code_with({"", ""}), 25832);
  EXPECT_THAT(codes(), ElementsAre());
}

class TurnedSurfaces : public TerrainTiles {
 protected:
  [[nodiscard]] TerrainFile model() const {
    std::ofstream(folder.file("straight.asc"))
        << "ncols 4\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\n10 10 0 0\n10 10 0 0\n";
    std::ofstream(folder.file("turned.vrt"))
        << R"(<VRTDataset rasterXSize="4" rasterYSize="2"><SRS>EPSG:25832</SRS>)"
        << R"(<GeoTransform>500000, 1.6, 1.2, 5500000, 1.2, -1.6</GeoTransform>)"
        << R"(<VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="1">straight.asc)"
        << "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
    return folder.file("turned.vrt");
  }
};

TEST_F(TurnedSurfaces, KeepsItsWallsUpright) {
  const Georeference frame = georeference_of_terrain(model(), {}, report);
  const TerrainRaster terrain = read_terrain(model(), "", frame, std::nullopt, report);
  EXPECT_TRUE(std::all_of(terrain.height_m.begin(), terrain.height_m.end(), [](const auto& height_m) {
    return !height_m || *height_m == 0.0F || *height_m == 10.0F;
  })) << "a height is of no pixel";
  EXPECT_LT(terrain.step_m.x, 1.0) << "squares are finer than the pixels";
  ASSERT_EQ(terrain.notes.size(), 1U);
  EXPECT_THAT(terrain.notes[0], HasSubstr("since it is turned, it is read in squares of "));
}

TEST_F(TurnedSurfaces, AloneKeepsItsPixelsWhereTheyAre) {
  const Georeference frame = georeference_of_terrain(model(), {}, report);
  const auto surface = read_turned_surface(model(), "", frame, report);
  ASSERT_TRUE(surface.has_value());
  ASSERT_EQ(surface->points_city.size(), 8U);
  // Half a pixel to the right and down from the corner of the first one; all numbers are exact in binary but for 0.2
  const Point2d first = Point2d{500000.0 + 0.8 + 0.6, 5500000.0 + 0.6 - 0.8} - frame.origin_m;
  constexpr double rounding_m = 1e-8;
  EXPECT_NEAR(surface->points_city[0].x, first.x, rounding_m);
  EXPECT_NEAR(surface->points_city[0].y, first.y, rounding_m);
  EXPECT_EQ(surface->points_city[0].z, 10.0);
  EXPECT_EQ(surface->points_city[2].z, 0.0);
  EXPECT_THAT(surface->notes, ElementsAre(HasSubstr("since it is turned")));
  EXPECT_FALSE(read_turned_surface(tile("north.asc", 0.0, 2.0, "1 2\n3 4\n"), "EPSG:25832", frame, report).has_value());
}

TEST_F(TurnedSurfaces, BelowACityIsSmooth) {
  const Georeference frame = georeference_of_terrain(model(), {}, report);
  const TerrainRaster terrain = read_terrain(model(), "", frame, Box2d{{-3.0, -3.0}, {3.0, 3.0}}, report);
  EXPECT_TRUE(std::any_of(terrain.height_m.begin(), terrain.height_m.end(),
                          [](const auto& height_m) { return height_m && *height_m > 1.0F && *height_m < 9.0F; }));
  EXPECT_TRUE(terrain.notes.empty());
}

}  // namespace
}  // namespace farlod::georeference
