// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/raster_reader.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "tests/scenes/test_data.hpp"

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::NanSensitiveFloatEq;
using testing::Optional;
using testing::UnorderedElementsAre;

class TerrainReader : public testing::Test {
 protected:
  void SetUp() override { GDALAllRegister(); }

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.file(name); }

  /// Three columns and two rows of 10 m, the north row first, south-west corner at (1000, 2000).
  [[nodiscard]] std::filesystem::path small_grid() const {
    std::ofstream(file("small.asc")) << "ncols 3\nnrows 2\nxllcorner 1000\nyllcorner 2000\ncellsize 10\nNODATA_value -9999\n"
                                        "1.5 2.5 3.5\n4.5 -9999 6.5\n";
    return file("small.asc");
  }

  Report report;

 private:
  scenes::TemporaryFolder folder_;
};

/// A frame in `code` whose origin is (500, 1500), so that forgetting it shows.
Georeference frame_in(const std::string& code) { return georeference_around({500.0, 1500.0}, *Crs::find(code)); }

struct NewRaster {
  std::string code;
  std::array<double, 6> transform;
  int columns, rows;
  GDALDataType type = GDT_Float64;
};

GDALDatasetUniquePtr make_raster(const std::filesystem::path& path, const NewRaster& raster) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDatasetUniquePtr dataset(driver->Create(path.c_str(), raster.columns, raster.rows, 1, raster.type, nullptr));
  std::array<double, 6> transform = raster.transform;
  dataset->SetGeoTransform(transform.data());
  OGRSpatialReference reference;
  reference.SetFromUserInput(raster.code.c_str());
  dataset->SetSpatialRef(&reference);
  return dataset;
}

/// Writes f(column, row) into every pixel; rows count from the north.
template <class F>
void fill(GDALDataset& dataset, F f) {
  for (int row = 0; row < dataset.GetRasterYSize(); ++row)
    for (int column = 0; column < dataset.GetRasterXSize(); ++column) {
      double value = f(column, row);
      ASSERT_EQ(dataset.GetRasterBand(1)->RasterIO(GF_Write, column, row, 1, 1, &value, 1, 1, GDT_Float64, 0, 0, nullptr),
                CE_None);
    }
}

TEST_F(TerrainReader, TakesARasterInTheOutputCrsAsItIs) {
  const TerrainRaster terrain = read_terrain(small_grid(), "EPSG:25832", frame_in("EPSG:25832"), std::nullopt, report);
  EXPECT_EQ(terrain.columns, 3u);
  EXPECT_EQ(terrain.rows, 2u);
  EXPECT_EQ(terrain.first, (Point2d{505.0, 505.0})) << "centre of the south-west pixel, minus the origin";
  EXPECT_EQ(terrain.step_m, (Point2d{10.0, 10.0}));
  EXPECT_THAT(terrain.height_m,
              ElementsAre(Optional(4.5F), std::nullopt, Optional(6.5F), Optional(1.5F), Optional(2.5F), Optional(3.5F)));
}

TEST_F(TerrainReader, TakesARasterWithoutACrsForOneInTheOutputCrs) {
  EXPECT_EQ(read_terrain(small_grid(), "", frame_in("EPSG:25832"), std::nullopt, report).first, (Point2d{505.0, 505.0}));
}

TEST_F(TerrainReader, ReadsOnePixelAroundTheWantedCity) {
  const auto path = file("wide.tif");
  auto dataset = make_raster(path, {"EPSG:25832", {900.0, 10.0, 0.0, 2500.0, 0.0, -10.0}, 100, 100});
  fill(*dataset, [](int column, int row) { return 100.0 * row + column; });
  dataset.reset();
  Box2d wanted;
  wanted.add({1007.0, 2007.0});
  wanted.add({1012.0, 2018.0});
  const Georeference frame = georeference_around({0.0, 0.0}, *Crs::find("EPSG:25832"));
  const TerrainRaster terrain = read_terrain(path, "", frame, wanted, report);
  EXPECT_TRUE(terrain.height_at({1007.0, 2007.0}).has_value());
  EXPECT_TRUE(terrain.height_at({1012.0, 2018.0}).has_value());
  EXPECT_EQ(terrain.columns, 4u) << "centres at 1005 and 1015 hold it, and one more at either side";
  EXPECT_EQ(terrain.rows, 5u) << "2005 to 2025, and one more at either side";
  EXPECT_EQ(terrain.first, (Point2d{995.0, 1995.0}));
  EXPECT_THAT(terrain.height_m.front(), Optional(100.0F * 50.0F + 9.0F)) << "column 9 of row 50";
}

TEST_F(TerrainReader, HonoursScaleOffsetAndUnit) {
  for (const auto& [unit, metres] :
       {std::pair("ft", 0.3048), std::pair("feet", 0.3048), std::pair("US survey foot", 1200.0 / 3937.0), std::pair("metre", 1.0),
        std::pair("dm", 0.1), std::pair("cm", 0.01), std::pair("Centimeters", 0.01), std::pair("mm", 0.001),
        std::pair("km", 1000.0)}) {
    const auto path = file(std::string(unit) + ".tif");
    auto dataset = make_raster(path, {"EPSG:25832", {1000.0, 10.0, 0.0, 3000.0, 0.0, -10.0}, 2, 2, GDT_Int16});
    fill(*dataset, [](int column, int row) { return 10.0 * row + column; });
    // Of kilometres so few that they are still a place on the Earth
    const double scale = metres > 1.0 ? 0.005 : 0.5;
    dataset->GetRasterBand(1)->SetScale(scale);
    dataset->GetRasterBand(1)->SetOffset(200.0 * scale);
    dataset->GetRasterBand(1)->SetUnitType(unit);
    dataset.reset();
    const TerrainRaster terrain = read_terrain(path, "", frame_in("EPSG:25832"), std::nullopt, report);
    EXPECT_FLOAT_EQ(terrain.height_m[0].value_or(0.0F), static_cast<float>(metres * scale * 210.0)) << unit;
  }
}

TEST_F(TerrainReader, CountsHeightsInTheFeetOfTheCrs) {
  const auto path = file("state_plane.tif");
  auto dataset = make_raster(path, {"EPSG:2263", {1025000.0, 10.0, 0.0, 172918.0, 0.0, -10.0}, 20, 20});
  fill(*dataset, [](int, int) { return 100.0; });
  dataset.reset();
  const Georeference frame = georeference_of_terrain(path, {}, report);
  EXPECT_EQ(frame.epsg, 32118);
  const TerrainRaster terrain = read_terrain(path, "", frame, std::nullopt, report);
  const auto height_m = terrain.height_at({0.0, 0.0});
  ASSERT_TRUE(height_m.has_value());
  EXPECT_EQ(static_cast<float>(*height_m), static_cast<float>(100.0 * 1200.0 / 3937.0));
}

/// More than the rasters below: a terrain is read, and no surface model.
const Box2d below_a_city{{-5000.0, -5000.0}, {5000.0, 5000.0}};

// A plane stays a plane under bilinear resampling, up to the bend of the one projection in the other
TEST_F(TerrainReader, ResamplesFromDegrees) {
  const auto path = file("degrees.tif");
  constexpr double step_deg = 1e-4, west_deg = 8.0, north_deg = 50.0;
  auto dataset = make_raster(path, {"EPSG:4326", {west_deg, step_deg, 0.0, north_deg, 0.0, -step_deg}, 200, 200});
  fill(*dataset, [](int column, int row) { return 100.0 + 0.1 * column - 0.05 * row; });
  dataset->GetRasterBand(1)->SetNoDataValue(-1.0);
  dataset.reset();
  const Georeference frame = georeference_of_terrain(path, {}, report);
  EXPECT_EQ(frame.epsg, 32632);
  const TerrainRaster terrain = read_terrain(path, "", frame, below_a_city, report);
  const Crs utm = *Crs::find("EPSG:32632");
  const CrsTransformation to_degrees(utm, *Crs::find("EPSG:4326"), frame.origin_m);
  for (const Point2d p_city : {Point2d{0.0, 0.0}, Point2d{200.0, -300.0}, Point2d{-250.0, 310.0}}) {
    const auto place = to_degrees.apply(p_city + frame.origin_m);
    const auto height_m = terrain.height_at(p_city);
    ASSERT_TRUE(place && height_m);
    const double column = (place->x - west_deg) / step_deg - 0.5, row = (north_deg - place->y) / step_deg - 0.5;
    // Heights are floats; within a pixel of 11 m the projections bend against each other by 11²/(8·6.4e6) m, 1e-6 of a pixel
    constexpr double float_and_bend_m = 120.0 * 6e-8 * 2.0 + 1e-6;
    EXPECT_NEAR(*height_m, 100.0 + 0.1 * column - 0.05 * row, float_and_bend_m);
  }
  EXPECT_FALSE(terrain.height_m.front().has_value()) << "the corners of a turned raster are empty";
}

TEST_F(TerrainReader, ResamplesATurnedRaster) {
  const auto path = file("turned.tif");
  auto dataset = make_raster(path, {"EPSG:25832", {500000.0, 8.0, 6.0, 5600000.0, 6.0, -8.0}, 60, 60});
  fill(*dataset, [](int column, int) { return 1.0 * column; });
  dataset.reset();
  const Georeference frame = georeference_of_terrain(path, {}, report);
  const TerrainRaster terrain = read_terrain(path, "", frame, below_a_city, report);
  const auto height_m = terrain.height_at({0.0, 0.0});
  ASSERT_TRUE(height_m.has_value());
  constexpr double origin_rounding_pixels = 0.5 * (8.0 + 6.0) / 100.0 + 1e-5;  // half a metre along each axis, in pixels of 10 m
  EXPECT_NEAR(*height_m, 29.5, origin_rounding_pixels) << "the middle of the raster";
}

TEST_F(TerrainReader, SaysWhatIsWrong) {
  std::ofstream(file("not.tif")) << "no raster";
  auto dataset = make_raster(file("far.tif"), {"EPSG:25832", {500000.0, 10.0, 0.0, 5600000.0, 0.0, -10.0}, 5, 5});
  dataset.reset();
  Box2d wanted;
  wanted.add({0.0, 0.0});
  const auto message = [&](const std::string& name) -> std::string {
    return scenes::refusal_of<InputError>([&] { (void)read_terrain(file(name), "", frame_in("EPSG:25832"), wanted, report); });
  };
  EXPECT_THAT(message("absent.tif"), HasSubstr("absent.tif"));
  EXPECT_THAT(message("not.tif"), HasSubstr("is not a raster"));
  // It blamed --crs, and did not tell where the two lie
  EXPECT_THAT(
      message("far.tif"),
      AllOf(HasSubstr("far.tif does not meet the city: it lies from 500000, 5599950 to 500050, 5600000 in ETRS89 / UTM zone "
                      "32N (its own CRS); the city with its cells lies from 500, 1500 to 500, 1500 in")));
  EXPECT_THROW((void)georeference_of_terrain(small_grid(), {}, report), InputError) << "no CRS anywhere";
}

TEST_F(TerrainReader, ReadsTheSurfaceModelOfGothenburg) {
  const std::filesystem::path path = scenes::test_data("goteborg/dsm.asc");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << scenes::absence_of(path);
  const Georeference frame = georeference_of_terrain(path, {"EPSG:3007", ""}, report);
  EXPECT_EQ(frame.epsg, 3007);
  EXPECT_EQ(frame.origin_m, (Point2d{147740.0 + 95.0, 6398620.0 + 65.0}));
  const TerrainRaster terrain = read_terrain(path, "EPSG:3007", frame, std::nullopt, report);
  EXPECT_EQ(terrain.columns, 190u);
  EXPECT_EQ(terrain.rows, 130u);
  EXPECT_EQ(terrain.first, (Point2d{-94.5, -64.5}));
  EXPECT_THAT(terrain.height_m[129 * 190], Optional(21.2248F)) << "the first number of the file is the north-west";
}

const float none = std::numeric_limits<float>::quiet_NaN();
const Box2d whole_city{{-1000.0, -1000.0}, {1000.0, 1000.0}};

std::vector<float> all_of(const PagedArray<float>& array) { return {array.begin(), array.end()}; }

class CanopyReader : public testing::Test {
 protected:
  /// An ESRI ASCII grid; `sides` are lines such as "cellsize 2".
  [[nodiscard]] std::filesystem::path grid(const std::string& name, const std::string& corner, const std::string& sides,
                                           const std::string& size, const std::string& values) const {
    std::ofstream(folder_.file(name)) << size << corner << sides << "\nNODATA_value -9999\n" << values;
    return folder_.file(name);
  }
  [[nodiscard]] std::filesystem::path tops() const {
    return grid("tops.asc", "xllcorner 1000\nyllcorner 2000\n", "cellsize 2", "ncols 3\nnrows 2\n", "1 2 3\n4 -9999 6\n");
  }
  [[nodiscard]] static std::pair<CanopyRaster, std::vector<std::string>> read(const CanopyFiles& files,
                                                                              const Box2d& wanted = whole_city) {
    return read_canopy(files, "EPSG:25832", georeference_around({1000.0, 2000.0}, *Crs::find("EPSG:25832")), wanted);
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(CanopyReader, TakesSquaresInTheOutputCrsAsTheyAre) {
  const auto [canopy, notes] = read({tops(), {}});
  EXPECT_EQ(canopy.columns, 3U);
  EXPECT_EQ(canopy.rows, 2U);
  EXPECT_EQ(canopy.centre(0, 0), (Point2d{1.0, 3.0})) << "the north-western cell";
  EXPECT_EQ(canopy.centre(2, 1), (Point2d{5.0, 1.0}));
  EXPECT_THAT(all_of(canopy.top_m), ElementsAre(1.0F, 2.0F, 3.0F, 4.0F, NanSensitiveFloatEq(none), 6.0F));
  EXPECT_TRUE(canopy.trunk_m.empty());
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(CanopyReader, ReadsOnlyWhatIsWanted) {
  const auto canopy = read({tops(), {}}, {{-10.0, -10.0}, {0.5, 0.5}}).first;
  EXPECT_EQ(canopy.columns, 2U) << "the wanted column, and one beside it";
  EXPECT_EQ(canopy.centre(0, 0), (Point2d{1.0, 3.0}));
  EXPECT_THROW((void)read({tops(), {}}, {{500.0, 500.0}, {600.0, 600.0}}), InputError);
}

TEST_F(CanopyReader, AsksRastersOfTrunksAtTheCentresOfCells) {
  const auto alike =
      grid("alike.asc", "xllcorner 1000\nyllcorner 2000\n", "cellsize 2", "ncols 3\nnrows 2\n", "0 1 2\n3 4 -9999\n");
  const auto [canopy, notes] = read({tops(), alike});
  EXPECT_THAT(all_of(canopy.trunk_m), ElementsAre(0.0F, 1.0F, 2.0F, 3.0F, 4.0F, NanSensitiveFloatEq(none)));
  EXPECT_THAT(notes, IsEmpty());
  // Pixels of 4 m, of which the second one covers the last column but for its right half
  const auto coarse = grid("coarse.asc", "xllcorner 1000\nyllcorner 2000\n", "cellsize 4", "ncols 2\nnrows 1\n", "1 2\n");
  const auto [other, told] = read({tops(), coarse});
  EXPECT_THAT(all_of(other.trunk_m), ElementsAre(1.0F, 1.0F, 2.0F, 1.0F, 1.0F, 2.0F));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("another extent or resolution"));
  // One that ends before
  const auto small = grid("small.asc", "xllcorner 1002\nyllcorner 2002\n", "cellsize 2", "ncols 1\nnrows 1\n", "1\n");
  const auto none_there = NanSensitiveFloatEq(none);
  EXPECT_THAT(all_of(read({tops(), small}).first.trunk_m),
              ElementsAre(none_there, 1.0F, none_there, none_there, none_there, none_there));
  const auto elsewhere = grid("elsewhere.asc", "xllcorner 9000\nyllcorner 2002\n", "cellsize 2", "ncols 1\nnrows 1\n", "1\n");
  EXPECT_THAT(all_of(read({tops(), elsewhere}).first.trunk_m), testing::Each(none_there));
}

TEST_F(CanopyReader, BringsOtherPixelsIntoSquares) {
  const auto oblong =
      grid("oblong.asc", "xllcorner 1000\nyllcorner 2000\n", "dx 4\ndy 2", "ncols 2\nnrows 2\n", "1 2\n3 -9999\n");
  const auto [canopy, notes] = read({oblong, {}});
  EXPECT_EQ(canopy.columns, 4U);
  EXPECT_EQ(canopy.rows, 2U);
  EXPECT_NEAR(norm(canopy.column_step), 2.0, 1e-9);
  const auto no = NanSensitiveFloatEq(none);
  EXPECT_THAT(all_of(canopy.top_m), ElementsAre(1.0F, 1.0F, 2.0F, 2.0F, 3.0F, 3.0F, no, no));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("its pixels are no squares, it is read in squares of 2 m"));
}

TEST_F(CanopyReader, TurnedSquaresStayTurned) {
  const auto path = folder_.file("turned.vrt");
  // 3 m and 4 m east and north from column to column: squares of 5 m
  std::ofstream(path) << R"(<VRTDataset rasterXSize="3" rasterYSize="2"><GeoTransform>1000, 3, 4, 2000, 4, -3</GeoTransform>)"
                      << R"(<VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="1">tops.asc)"
                      << "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
  (void)tops();
  const auto [canopy, notes] = read({path, {}});
  EXPECT_EQ(canopy.column_step, (Point2d{3.0, 4.0}));
  EXPECT_EQ(canopy.row_step, (Point2d{4.0, -3.0}));
  EXPECT_EQ(canopy.centre(0, 0), (Point2d{3.5, 0.5}));
  EXPECT_EQ(canopy.columns * canopy.rows, 6U);
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(CanopyReader, RefusesWhatIsNone) {
  EXPECT_THROW((void)read({folder_.file("lost.tif"), {}}), InputError);
  std::ofstream(folder_.file("text.tif")) << "no raster";
  EXPECT_THROW((void)read({folder_.file("text.tif"), {}}), InputError);
  EXPECT_THROW((void)read({tops(), folder_.file("text.tif")}), InputError);
}

/// The code and the detail of each problem.
std::vector<std::string> told(const Report& report) {
  std::vector<std::string> lines;
  for (const Problem& p : report.problems()) lines.push_back(std::to_string(static_cast<int>(p.code)) + " " + p.detail);
  return lines;
}

/// A raster at 500 m whose first 2 × 2 pixels hold `number`, without saying what it stands for.
std::filesystem::path with_hole(const std::filesystem::path& path, const std::string& code, std::array<double, 6> transform,
                                double number) {
  const auto dataset = make_raster(path, {code, transform, 20, 20, GDT_Float32});
  fill(*dataset, [&](int column, int row) { return column < 2 && row < 2 ? number : 500.0; });
  return path;
}

TEST_F(TerrainReader, NumbersThatNobodyDeclaredAsNoDataAreEmpty) {
  for (const double number : {-9999.0, -3.4028234663852886e38, 0.0}) {
    report = Report();
    const auto path = with_hole(file("hole.tif"), "EPSG:25832", {690000.0, 10.0, 0.0, 5335000.0, 0.0, -10.0}, number);
    const TerrainRaster terrain = read_terrain(path, "", georeference_of_terrain(path, {}, report), std::nullopt, report);
    EXPECT_EQ(std::count(terrain.height_m.begin(), terrain.height_m.end(), std::nullopt), 4) << number;
    EXPECT_EQ(std::count(terrain.height_m.begin(), terrain.height_m.end(), 500.0F), 396) << number;
    EXPECT_THAT(told(report), ElementsAre(AllOf(HasSubstr("(4 of 400 pixels here, "), HasSubstr("gdal_edit.py -a_nodata"))));
  }
}

TEST_F(TerrainReader, TheyAreNotMixedIntoTheirNeighborsWhereARasterIsResampled) {
  const auto path = with_hole(file("hole.tif"), "EPSG:4326", {11.55, 1e-4, 0.0, 48.14, 0.0, -1e-4}, -9999.0);
  const TerrainRaster terrain = read_terrain(path, "", georeference_of_terrain(path, {}, report), std::nullopt, report);
  EXPECT_THAT(told(report), ElementsAre(HasSubstr("211 -9999 is no height here")));
  for (const auto& height_m : terrain.height_m)
    if (height_m) {
      EXPECT_FLOAT_EQ(*height_m, 500.0F);
    }
}

TEST_F(TerrainReader, SeveralOfThemInOneRasterAreNotMixedEither) {
  // As a warp leaves it: zeros around a raster with holes of another number, and a third one that is declared
  const auto dataset = make_raster(file("holes.tif"), {"EPSG:4326", {11.55, 1e-4, 0.0, 48.14, 0.0, -1e-4}, 20, 20, GDT_Float32});
  dataset->GetRasterBand(1)->SetNoDataValue(-9999.0);
  fill(*dataset, [](int column, int row) {
    if (column < 3) return row < 3 ? -9999.0 : 0.0;
    return column > 10 && row > 10 ? -32768.0 : 500.0;
  });
  dataset->FlushCache();
  const TerrainRaster terrain =
      read_terrain(file("holes.tif"), "", georeference_of_terrain(file("holes.tif"), {}, report), std::nullopt, report);
  EXPECT_THAT(told(report),
              UnorderedElementsAre(HasSubstr("211 -32768 is no height here"), HasSubstr("211 0 is no height here")));
  for (const auto& height_m : terrain.height_m)
    if (height_m) {
      EXPECT_FLOAT_EQ(*height_m, 500.0F);
    }
}

TEST_F(TerrainReader, OfALargeRasterSomeBlocksAreSampled) {
  const auto small = make_raster(file("small.tif"), {"EPSG:4326", {11.55, 1e-5, 0.0, 48.14, 0.0, -1e-5}, 1200, 1200, GDT_Byte});
  small->GetRasterBand(1)->Fill(50.0);
  std::vector<double> zeros(std::size_t{40} * 40);
  ASSERT_EQ(small->GetRasterBand(1)->RasterIO(GF_Write, 700, 900, 40, 40, zeros.data(), 40, 40, GDT_Float64, 0, 0, nullptr),
            CE_None);
  CPLStringList blocks(CSLTokenizeString2("TILED=YES BLOCKXSIZE=16 BLOCKYSIZE=16", " ", 0), TRUE);
  GDALClose(small->GetDriver()->CreateCopy(file("large.tif").c_str(), small.get(), 0, blocks.List(), nullptr, nullptr));
  (void)read_terrain(file("large.tif"), "", georeference_of_terrain(file("large.tif"), {}, report),
                     Box2d{{-5.0, -5.0}, {5.0, 5.0}}, report);
  EXPECT_THAT(told(report), ElementsAre(HasSubstr("211 0 is no height here")));
}

TEST_F(TerrainReader, APlaceThatCannotBeIsToldAsThatOfABuildingIs) {
  const auto read = [&](const std::string& code, std::array<double, 6> transform) {
    report = Report();
    const auto path = with_hole(file("place.tif"), code, transform, 500.0);
    const Georeference frame = georeference_around({transform[0], transform[3]}, *Crs::find(code));
    return scenes::refusal_of<InputError>([&] { (void)read_terrain(path, "", frame, std::nullopt, report); });
  };
  EXPECT_THAT(read("EPSG:25832", {11.55, 1e-4, 0.0, 48.14, 0.0, -1e-4}), HasSubstr("its coordinates look like degrees"));
  EXPECT_EQ(read("EPSG:25832", {3e6, 10.0, 0.0, 5335000.0, 0.0, -10.0}), "no refusal");
  EXPECT_THAT(told(report), ElementsAre(HasSubstr("205 the file lies at 3000100, 5334900")));
  EXPECT_EQ(read("EPSG:25832", {690000.0, 0.0005, 0.0, 5335000.0, 0.0, -0.0005}), "no refusal");
  EXPECT_THAT(told(report), ElementsAre(HasSubstr("208 its pixels are 0.0005 m wide")));
}

}  // namespace
}  // namespace farlod::georeference
