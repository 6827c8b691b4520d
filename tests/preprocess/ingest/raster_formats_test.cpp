// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include <array>
#include <map>
#include <memory>

#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/files/input_search.hpp"
#include "reading.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
namespace fs = std::filesystem;

class RasterFormats : public testing::Test {
 protected:
  void SetUp() override { GDALAllRegister(); }

  /// A table of 4 × 3 pixels of heights in a GeoPackage, new or not.
  [[nodiscard]] fs::path add_tiles(const std::string& name, const char* table) const {
    const fs::path path = folder.file(name);
    GDALDriverManager& formats = *GetGDALDriverManager();
    const GDALDatasetUniquePtr heights(formats.GetDriverByName("MEM")->Create("", 4, 3, 1, GDT_Float32, nullptr));
    std::array<double, 6> transform{690000.0, 1.0, 0.0, 5335000.0, 0.0, -1.0};
    heights->SetGeoTransform(transform.data());
    OGRSpatialReference utm;
    utm.importFromEPSG(25832);
    heights->SetSpatialRef(&utm);
    const std::string table_option = std::string("RASTER_TABLE=") + table;
    const std::array<const char*, 3> options{table_option.c_str(), fs::exists(path) ? "APPEND_SUBDATASET=YES" : nullptr, nullptr};
    const GDALDatasetUniquePtr copy(formats.GetDriverByName("GPKG")->CreateCopy(
        path.c_str(), heights.get(), 0, const_cast<char**>(options.data()), nullptr, nullptr));
    EXPECT_NE(copy, nullptr);
    return path;
  }
  static void add_outlines(const fs::path& path, const char* table) {
    const GDALDatasetUniquePtr file(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    OGRSpatialReference utm;
    utm.importFromEPSG(25832);
    ASSERT_NE(file->CreateLayer(table, &utm, wkbPolygon, nullptr), nullptr);
  }
  FoundInputs find(const fs::path& input, const std::optional<std::string>& layer = {}) {
    return find_input_files(std::vector{input}, report, layer);
  }

  const scenes::TemporaryFolder folder;
  Report report;
};

TEST_F(RasterFormats, AGeoPackageOfTilesIsASurfaceModel) {
  const FoundInputs found = find(add_tiles("dsm.gpkg", "dsm"));
  EXPECT_THAT(found.files, IsEmpty());
  EXPECT_THAT(found.surface_models, SizeIs(1));
}

TEST_F(RasterFormats, OfTilesAndFeaturesTheFeaturesAreReadUnlessTilesAreNamed) {
  const fs::path both = add_tiles("both.gpkg", "dsm");
  add_outlines(both, "houses");
  EXPECT_THAT(find(both).files, SizeIs(1));
  EXPECT_THAT(find(both, "houses").files, SizeIs(1));
  EXPECT_THAT(find(both, "neither").files, SizeIs(1)) << "its reader says which there are";
  EXPECT_THAT(find(both, "dsm").surface_models, SizeIs(1));
}

/// An array of netCDF.
struct Variable {
  const char* name;
  std::vector<std::string> dimensions;
  std::vector<double> values;
  double scale = 1.0;  ///< what a number of the file stands for
};

/// A static driver of PALM: 6 × 4 cells of 2 m.
class PalmDrivers : public RasterFormats {
 protected:
  static constexpr std::size_t columns = 6, rows = 4;
  static constexpr double no_data = -9999.0, ground_m = 3.0, origin_z_m = 500.0;
  static constexpr Point2d origin{690000.0, 5335000.0};

  /// A value for each cell, by column and row from the south-west.
  template <class F>
  static std::vector<double> cells(F f) {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) values.push_back(f(column, row));
    return values;
  }
  static Variable terrain() {
    return {"zt", {"y", "x"}, cells([](std::size_t, std::size_t) { return ground_m; })};
  }

  [[nodiscard]] fs::path write(const std::vector<Variable>& variables, double rotation_deg = 0.0) const {
    const fs::path path = folder.file("palm.nc");
    GDALDriver& format = *GetGDALDriverManager()->GetDriverByName("netCDF");
    const GDALDatasetUniquePtr file(format.CreateMultiDimensional(path.c_str(), nullptr, nullptr));
    const auto root = file->GetRootGroup();
    const auto number = GDALExtendedDataType::Create(GDT_Float64);
    const auto set = [&](const char* name, double value) { root->CreateAttribute(name, {}, number)->Write(value); };
    set("origin_x", origin.x);
    set("origin_y", origin.y);
    set("origin_z", origin_z_m);
    set("rotation_angle", rotation_deg);
    std::map<std::string, std::shared_ptr<GDALDimension>> dimensions{{"x", root->CreateDimension("x", "", "", columns)},
                                                                     {"y", root->CreateDimension("y", "", "", rows)},
                                                                     {"z", root->CreateDimension("z", "", "", 4)}};
    const auto crs = root->CreateMDArray("crs", {}, GDALExtendedDataType::Create(GDT_Int32));
    crs->CreateAttribute("epsg_code", {}, GDALExtendedDataType::CreateString())->Write("EPSG:25832");
    std::vector<Variable> all = variables;
    all.push_back({"x", {"x"}, {1.0, 3.0, 5.0, 7.0, 9.0, 11.0}});
    all.push_back({"y", {"y"}, {1.0, 3.0, 5.0, 7.0}});
    all.push_back({"z", {"z"}, {0.0, 1.0, 3.0, 5.0}});
    for (const Variable& variable : all) {
      std::vector<std::shared_ptr<GDALDimension>> own;
      for (const std::string& name : variable.dimensions) own.push_back(dimensions.at(name));
      const auto array = root->CreateMDArray(variable.name, own, number);
      array->SetNoDataValue(no_data);
      if (variable.scale != 1.0) array->SetScale(variable.scale);
      std::vector<GUInt64> first(own.size(), 0);
      std::vector<std::size_t> counts;
      for (const auto& dimension : own) counts.push_back(dimension->GetSize());
      EXPECT_TRUE(array->Write(first.data(), counts.data(), nullptr, nullptr, number, variable.values.data()));
    }
    return path;
  }
  /// The upper and the lower end of the points of a building.
  static std::pair<double, double> extent_of(const CityModel& city, const Building& building) {
    std::pair<double, double> extent{1e9, -1e9};
    for (const Point3d& p : city.points_of(building)) extent = {std::min(extent.first, p.z), std::max(extent.second, p.z)};
    return extent;
  }
};

TEST_F(PalmDrivers, GroundAndBuildings) {
  const Variable heights{"buildings_2d", {"y", "x"}, cells([](std::size_t column, std::size_t row) {
                           return row < 2 && column >= 1 && column < 3 ? 12.0 : row == 3 && column == 5 ? 6.0 : no_data;
                         })};
  const Variable ids{"building_id", {"y", "x"}, cells([](std::size_t column, std::size_t row) {
                       return row < 2 && column >= 1 && column < 3 ? 200'000.0 : no_data;
                     })};
  const fs::path path = write({terrain(), heights, ids});
  EXPECT_THAT(find(path).files, SizeIs(1)) << "a city, and no surface model";
  const Reading read = read_file(path);
  EXPECT_EQ(read.source.crs.definition, "EPSG:25832");
  ASSERT_THAT(read.source.relief_points, SizeIs(columns * rows));
  EXPECT_EQ(read.source.relief_points.front(), (Point3d{origin.x + 1.0, origin.y + 1.0, origin_z_m + ground_m}));
  ASSERT_THAT(read.city().buildings(), SizeIs(2));
  const Building& block = read.city().buildings()[0];
  EXPECT_EQ(block.id, "200000");
  EXPECT_EQ(block.height_reference, HeightReference::on_ground);
  EXPECT_EQ(extent_of(read.city(), block), (std::pair{0.0, 12.0}));
  EXPECT_EQ(block.facet_count, 6U) << "four cells are one prism";
  Box2d outline;
  for (const Point3d& p : read.city().points_of(block)) outline.add(horizontal(p));
  EXPECT_EQ(outline.low, (Point2d{origin.x + 2.0, origin.y}));
  EXPECT_EQ(outline.high, (Point2d{origin.x + 6.0, origin.y + 4.0}));
  EXPECT_EQ(read.city().buildings()[1].id, "cells 1");
  EXPECT_THAT(read.report.problems(), IsEmpty());
}

TEST_F(PalmDrivers, AreTurnedAboutTheirOrigin) {
  const Reading read = read_file(write({terrain()}, 90.0));
  // The y axis points east, and x south
  const Point3d first = read.source.relief_points.front(), last = read.source.relief_points.back();
  constexpr double rounding_m = 1e-6;
  EXPECT_NEAR(first.x, origin.x + 1.0, rounding_m);
  EXPECT_NEAR(first.y, origin.y - 1.0, rounding_m);
  EXPECT_NEAR(last.x, origin.x + 7.0, rounding_m);
  EXPECT_NEAR(last.y, origin.y - 11.0, rounding_m);
}

TEST_F(PalmDrivers, CellsInSpaceLeaveFreeWhatIsBelowThem) {
  Variable cells_3d{"buildings_3d", {"z", "y", "x"}, std::vector<double>(4 * columns * rows, 0.0)};
  for (std::size_t layer = 0; layer < 3; ++layer) cells_3d.values[layer * columns * rows] = 1.0;  // from the ground up
  cells_3d.values[3 * columns * rows + 5] = 1.0;                                                  // as a bridge
  const Reading read = read_file(write({terrain(), cells_3d}));
  ASSERT_THAT(read.city().buildings(), SizeIs(2));
  // Layers end at 0, 2, 4 and 6 m
  EXPECT_EQ(extent_of(read.city(), read.city().buildings()[0]), (std::pair{0.0, 4.0}));
  EXPECT_EQ(extent_of(read.city(), read.city().buildings()[1]), (std::pair{4.0, 6.0}));
  EXPECT_EQ(read.city().buildings()[1].foot, Foot::above_ground);
}

/// PALM's lowest layer of cells has no height: what begins in the second one stands on the ground.
TEST_F(PalmDrivers, CellsOfTheSecondLayerStandOnTheGround) {
  Variable cells_3d{"buildings_3d", {"z", "y", "x"}, std::vector<double>(4 * columns * rows, 0.0)};
  cells_3d.values[columns * rows] = 1.0;
  const Reading read = read_file(write({terrain(), cells_3d}));
  ASSERT_THAT(read.city().buildings(), SizeIs(1));
  EXPECT_EQ(extent_of(read.city(), read.city().buildings()[0]), (std::pair{0.0, 2.0}));
}

TEST_F(PalmDrivers, NumbersOfTheFileMayBeScaled) {
  const Variable heights{
      "buildings_2d", {"y", "x"}, cells([](std::size_t column, std::size_t) { return column == 0 ? 120.0 : no_data; }), 0.125};
  const Reading read = read_file(write({terrain(), heights}));
  ASSERT_THAT(read.city().buildings(), SizeIs(1));
  EXPECT_EQ(extent_of(read.city(), read.city().buildings()[0]), (std::pair{0.0, 15.0}));
}

TEST_F(PalmDrivers, OfAnotherNumberOfCellsAreRefused) {
  const fs::path path = write({terrain(), {"buildings_2d", {"y"}, {1.0, 1.0, 1.0, 1.0}}});
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_file(path); }), HasSubstr("no value for each cell"));
}

}  // namespace
}  // namespace farlod::ingest::test
