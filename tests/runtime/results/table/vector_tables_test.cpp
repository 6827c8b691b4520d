// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <map>

#include "farlod/error.hpp"
#include "inputs/vector_reader_gdal.hpp"
#include "results/output_format.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

// Tables as vector files, read back by GDAL, which most of those who open our files use.

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

// Written with eight digits, and computed by PROJ, whose own series are good to a fraction of it
constexpr double degree_error = 1e-8;

GDALDatasetUniquePtr open_vector(const std::filesystem::path& path) {
  GDALAllRegister();
  return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
}

/// Two points with attributes and normals, of which the second has no answer.
struct TwoPoints {
  Attributes attributes{{"fid", "geom", "note", "count"}};
  std::vector<PointRow> rows{{"square", {500000.12345, 5700010.5}, 1.5, 0.1234567, 0.1, 0.75, 270.0, 45.5, {}, 1.25},
                             {"inside", {500100.0, 5700020.0}, {}, {}, {}, {}, {}, {}}};
  TableFrame frame{{"svf", BoundsColumns::yes}, small_raster().crs_wkt, 25832, {}, {"Far-LoD 1", "town.farlod", "0123", "--all"}};

  TwoPoints() {
    attributes.add_row(std::vector<std::string>{"7", "a", "the \"old\" <town>,\ttwo", "3"});
    attributes.add_row(std::vector<std::string>{"8", "b", "", "4"});
  }
  void write(const std::filesystem::path& path) const {
    const PointRows points{rows.size(), [this](std::size_t n) { return rows[n]; }, &attributes, true};
    output_format_of(path)->write_points(points, frame, path);
  }
};

struct FeatureDestroyer {
  void operator()(OGRFeature* feature) const { OGRFeature::DestroyFeature(feature); }
};
using OwnedFeature = std::unique_ptr<OGRFeature, FeatureDestroyer>;

/// The features of a layer by the value of a field.
std::map<std::string, OwnedFeature> features_by(OGRLayer& layer, const char* field) {
  std::map<std::string, OwnedFeature> features;
  layer.ResetReading();
  for (OwnedFeature f(layer.GetNextFeature()); f; f.reset(layer.GetNextFeature())) {
    const std::string key = f->GetFieldAsString(field);
    features.emplace(key, std::move(f));
  }
  return features;
}

std::vector<std::string> field_names(OGRLayer& layer) {
  std::vector<std::string> names;
  for (int n = 0; n < layer.GetLayerDefn()->GetFieldCount(); ++n)
    names.emplace_back(layer.GetLayerDefn()->GetFieldDefn(n)->GetNameRef());
  return names;
}

OGRFieldType type_of(OGRLayer& layer, const char* field) {
  return layer.GetLayerDefn()->GetFieldDefn(layer.GetLayerDefn()->GetFieldIndex(field))->GetType();
}

const char* endings[] = {".gpkg", ".fgb", ".geojson"};

TEST(VectorTables, HaveTheColumnsOfCsvWithTypes) {
  for (const std::string ending : endings) {
    SCOPED_TRACE(ending);
    const scenes::TemporaryFolder folder;
    TwoPoints().write(folder.file("a" + ending));
    EXPECT_THAT(folder.names(), ElementsAre("a" + ending));
    const auto dataset = open_vector(folder.file("a" + ending));
    ASSERT_NE(dataset, nullptr);
    OGRLayer& layer = *dataset->GetLayer(0);
    EXPECT_THAT(field_names(layer),
                ElementsAre("id", "fid", "geom", "note", "count", "x_m", "y_m", "z_m", "height_above_ground_m", "azimuth_deg",
                            "tilt_deg", "svf", "svf_low", "svf_high"));
    EXPECT_EQ(type_of(layer, "id"), OFTString);
    EXPECT_EQ(type_of(layer, "note"), OFTString);
    EXPECT_EQ(type_of(layer, "svf"), OFTReal);
    EXPECT_TRUE(type_of(layer, "count") == OFTInteger64 || type_of(layer, "count") == OFTInteger);
    const auto features = features_by(layer, "id");
    ASSERT_EQ(features.size(), 2U);
    OGRFeature& square = *features.at("square");
    EXPECT_EQ(square.GetFieldAsDouble("svf"), 0.123457);
    EXPECT_EQ(square.GetFieldAsDouble("x_m"), 500000.123);
    EXPECT_EQ(square.GetFieldAsDouble("tilt_deg"), 45.5);
    EXPECT_EQ(square.GetFieldAsDouble("height_above_ground_m"), 1.25);
    EXPECT_STREQ(square.GetFieldAsString("note"), "the \"old\" <town>,\ttwo");
    EXPECT_EQ(square.GetFieldAsInteger64("count"), 3);
    OGRFeature& inside = *features.at("inside");
    for (const char* empty : {"svf", "svf_low", "svf_high", "z_m", "height_above_ground_m", "azimuth_deg", "tilt_deg"})
      EXPECT_FALSE(inside.IsFieldSetAndNotNull(inside.GetFieldIndex(empty))) << empty;
  }
}

TEST(VectorTables, HavePlacesInTheCrsOfThePackage) {
  for (const std::string ending : {".gpkg", ".fgb"}) {
    SCOPED_TRACE(ending);
    const scenes::TemporaryFolder folder;
    TwoPoints().write(folder.file("a" + ending));
    const auto dataset = open_vector(folder.file("a" + ending));
    OGRLayer& layer = *dataset->GetLayer(0);
    EXPECT_EQ(layer.GetGeomType(), wkbPoint25D);
    ASSERT_NE(layer.GetSpatialRef(), nullptr);
    EXPECT_STREQ(layer.GetSpatialRef()->GetAuthorityCode(nullptr), "25832");
    const auto features = features_by(layer, "id");
    const OGRPoint& square = *features.at("square")->GetGeometryRef()->toPoint();
    EXPECT_EQ(square.getX(), 500000.123);
    EXPECT_EQ(square.getY(), 5700010.5);
    EXPECT_EQ(square.getZ(), 1.5);
    EXPECT_TRUE(std::isnan(features.at("inside")->GetGeometryRef()->toPoint()->getZ()));
  }
}

TEST(VectorTables, WithoutACodeTheCrsIsThatOfTheWkt) {
  for (const std::string ending : {".gpkg", ".fgb"}) {
    const scenes::TemporaryFolder folder;
    TwoPoints points;
    points.frame.epsg = std::nullopt;
    points.write(folder.file("a" + ending));
    const auto dataset = open_vector(folder.file("a" + ending));
    OGRSpatialReference expected;
    ASSERT_EQ(expected.importFromEPSG(25832), OGRERR_NONE);
    ASSERT_NE(dataset->GetLayer(0)->GetSpatialRef(), nullptr) << ending;
    EXPECT_TRUE(dataset->GetLayer(0)->GetSpatialRef()->IsSame(&expected)) << ending;
  }
}

TEST(GeoJson, HasLongitudeAndLatitude) {
  const scenes::TemporaryFolder folder;
  TwoPoints().write(folder.file("a.geojson"));
  const auto dataset = open_vector(folder.file("a.geojson"));
  OGRLayer& layer = *dataset->GetLayer(0);
  EXPECT_STREQ(layer.GetName(), "points");
  EXPECT_STREQ(layer.GetSpatialRef()->GetName(), "WGS 84");
  EXPECT_TRUE(layer.GetSpatialRef()->IsGeographic());
  const auto features = features_by(layer, "id");
  const OGRPoint& square = *features.at("square")->GetGeometryRef()->toPoint();
  // The easting of the central meridian is 500,000 m; a degree of longitude is 69.5 km there
  EXPECT_NEAR(square.getX(), 9.0 + 0.12345 / 69'500.0, degree_error);
  EXPECT_EQ(square.getZ(), 1.5);
  EXPECT_EQ(features.at("inside")->GetGeometryRef()->getCoordinateDimension(), 2);
  // And back again, by our reader
  const RequestedPoints read = read_points_gdal(folder.file("a.geojson"), "");
  ASSERT_EQ(read.points.size(), 2U);
  EXPECT_EQ(read.points[0].id, "square");
  EXPECT_THAT(scenes::text_of(folder.file("a.geojson")),
              testing::HasSubstr(R"("provenance": {"software": "Far-LoD 1", "package": "town.farlod")"));
}

TEST(GeoPackage, HasTheProvenanceAsMetadata) {
  const scenes::TemporaryFolder folder;
  TwoPoints().write(folder.file("a.gpkg"));
  const auto dataset = open_vector(folder.file("a.gpkg"));
  for (const auto& [name, value] : entries_of(TwoPoints().frame.provenance)) {
    ASSERT_NE(dataset->GetMetadataItem(name.c_str()), nullptr) << name;
    EXPECT_EQ(dataset->GetMetadataItem(name.c_str()), value);
  }
}

TEST(VectorTables, HaveTheSameBytesEachTime) {
  for (const std::string ending : endings) {
    const scenes::TemporaryFolder folder;
    TwoPoints().write(folder.file("a" + ending));
    const std::string first = scenes::text_of(folder.file("a" + ending));
    TwoPoints().write(folder.file("a" + ending));
    EXPECT_TRUE(first == scenes::text_of(folder.file("a" + ending))) << ending;
    EXPECT_NE(first, "") << ending;
  }
}

TEST(VectorTables, AFolderThatDoesNotExistIsTold) {
  for (const std::string ending : endings) {
    const scenes::TemporaryFolder folder;
    EXPECT_THROW(TwoPoints().write(folder.file("missing") / ("a" + ending)), OutputError) << ending;
    EXPECT_THAT(folder.names(), testing::IsEmpty()) << ending;
  }
}

/// Three receivers of two parts, of which the second comes first.
std::vector<std::filesystem::path> write_surfaces(const std::filesystem::path& path) {
  std::vector<SurfacePoint> rows(3);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    rows[n].building = "b" + std::to_string(n);
    rows[n].kind = SurfaceKind::wall;
    rows[n].p_projected = {500000.0 + static_cast<double>(n), 5700000.0, 10.0};
    if (n > 0) rows[n].svf = 0.25;
  }
  TableFrame frame{{"svf", BoundsColumns::no, {{"irradiation"}}, ThresholdColumns::yes}, small_raster().crs_wkt, 25832};
  const auto writer = output_format_of(path)->surface_tables_writer(frame, path);
  rows[0].further = {0.5F};
  rows[1].further = {1.5F};
  writer->write_part(8, std::span(rows).subspan(1));
  writer->write_part(2, std::span(rows).first(1));
  SurfaceMean mean;
  mean.building = "b1";
  mean.surface = 4;
  mean.receivers = 17;
  BuildingMean building;
  building.building = "b2";
  building.svf_walls = 0.125;
  building.further_walls = {500.5};
  building.wall_irradiation = {1001.0, 2.0};
  return writer->commit(std::vector{mean}, std::vector{building});
}

TEST(GeoPackage, HasThreeLayersOfSurfaces) {
  const scenes::TemporaryFolder folder;
  EXPECT_THAT(write_surfaces(folder.file("a.gpkg")), ElementsAre(folder.file("a.gpkg")));
  EXPECT_THAT(folder.names(), ElementsAre("a.gpkg"));
  const auto dataset = open_vector(folder.file("a.gpkg"));
  ASSERT_EQ(dataset->GetLayerCount(), 3);
  OGRLayer& receivers = *dataset->GetLayerByName("receivers");
  std::vector<std::string> buildings;
  for (const auto& feature : receivers) buildings.emplace_back(feature->GetFieldAsString("building"));
  EXPECT_THAT(buildings, ElementsAre("b0", "b1", "b2"));
  const auto by_building = features_by(receivers, "building");
  EXPECT_EQ(by_building.at("b1")->GetFieldAsDouble("irradiation"), 1.5);
  EXPECT_FALSE(by_building.at("b2")->IsFieldSetAndNotNull(by_building.at("b2")->GetFieldIndex("irradiation")));
  EXPECT_STREQ(by_building.at("b0")->GetFieldAsString("kind"), "wall");
  OGRLayer& surfaces = *dataset->GetLayerByName("surfaces");
  EXPECT_EQ(surfaces.GetGeomType(), wkbNone);
  EXPECT_EQ(features_by(surfaces, "building").at("b1")->GetFieldAsInteger64("receivers"), 17);
  EXPECT_GE(surfaces.GetLayerDefn()->GetFieldIndex("irradiation_kwh"), 0);
  OGRLayer& of_buildings = *dataset->GetLayerByName("buildings");
  const auto buildings_by_id = features_by(of_buildings, "building");
  const auto& b2 = buildings_by_id.at("b2");
  EXPECT_EQ(b2->GetFieldAsDouble("svf_walls"), 0.125);
  EXPECT_FALSE(b2->IsFieldSetAndNotNull(b2->GetFieldIndex("roof_area_m2")));
  EXPECT_EQ(b2->GetFieldAsDouble("irradiation_walls"), 500.5);
  EXPECT_EQ(b2->GetFieldAsDouble("wall_irradiation_kwh"), 1001.0);
  EXPECT_EQ(b2->GetFieldAsDouble("wall_area_above_m2"), 2.0);
  EXPECT_FALSE(b2->IsFieldSetAndNotNull(b2->GetFieldIndex("roof_irradiation_kwh")));
}

TEST(VectorTables, OtherFormatsHaveTheTablesWithoutPlacesAsCsv) {
  for (const std::string ending : {".fgb", ".geojson", ".ply"}) {
    const scenes::TemporaryFolder folder;
    EXPECT_THAT(write_surfaces(folder.file("a" + ending)),
                ElementsAre(folder.file("a" + ending), folder.file("a.surfaces.csv"), folder.file("a.buildings.csv")));
    EXPECT_THAT(folder.names(), UnorderedElementsAre("a" + ending, "a.surfaces.csv", "a.buildings.csv"));
    if (ending == ".ply") continue;
    const auto dataset = open_vector(folder.file("a" + ending));
    EXPECT_EQ(dataset->GetLayer(0)->GetFeatureCount(), 3) << ending;
  }
}

TEST(VectorTables, NothingIsLeftOfAFileThatIsGivenUp) {
  for (const std::string ending : endings) {
    const scenes::TemporaryFolder folder;
    {
      const auto writer = output_format_of("a" + ending)->surface_tables_writer({{"svf"}}, folder.file("a" + ending));
      writer->write_part(0, std::vector<SurfacePoint>(3));
    }
    EXPECT_THAT(folder.names(), testing::IsEmpty()) << ending;
  }
}

// Points as netCDF, read back by GDAL's driver of arrays of any dimension.

/// More rows than are written at a time, of which every third has no answer; the longest id comes last.
constexpr std::size_t count = 40'000;

std::string id_of(std::size_t n) { return n + 1 == count ? "die längste von allen" : "p" + std::to_string(n); }

class CfPoints : public testing::Test {
 protected:
  CfPoints() {
    Attributes attributes{{"a/b", "height"}};
    for (std::size_t n = 0; n < count; ++n)
      attributes.add_row(std::vector<std::string>{n == 1 ? "" : std::to_string(n), std::to_string(n) + ".5"});
    std::string id;
    const auto row = [&id](std::size_t n) {
      id = id_of(n);
      PointRow point{id, {500000.0 + static_cast<double>(n), 5700000.5}, 1.5, 0.25, 0.125, 0.5, {}, {}};
      if (n % 3 == 2) point.svf = point.low = point.high = std::nullopt;
      return point;
    };
    const TableFrame frame{
        {"svf", BoundsColumns::yes}, small_raster().crs_wkt, 25832, {}, {"Far-LoD 1", "town.farlod", "0", "-"}};
    output_format_of("p.nc")->write_points({count, row, &attributes, false}, frame, folder_.file("p.nc"));
    GDALAllRegister();
    file_.reset(GDALDataset::Open(folder_.file("p.nc").c_str(), GDAL_OF_MULTIDIM_RASTER));
    root_ = file_ ? file_->GetRootGroup() : nullptr;
  }
  [[nodiscard]] std::shared_ptr<GDALMDArray> column(const std::string& name) const { return root_->OpenMDArray(name); }
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const {
    std::vector<double> values(count);
    const std::vector<GUInt64> first{0};
    const std::vector<size_t> size{count};
    EXPECT_TRUE(column(name)->Read(first.data(), size.data(), nullptr, nullptr, GDALExtendedDataType::Create(GDT_Float64),
                                   values.data()));
    return values;
  }
  [[nodiscard]] std::string text(const std::string& variable, const char* attribute) const {
    const auto found = column(variable)->GetAttribute(attribute);
    return found ? found->ReadAsString() : "";
  }

  scenes::TemporaryFolder folder_;
  GDALDatasetUniquePtr file_;
  std::shared_ptr<GDALGroup> root_;
};

TEST_F(CfPoints, HaveTheirValuesRowByRow) {
  ASSERT_NE(root_, nullptr);
  const std::vector<double> svf = numbers("svf"), x_m = numbers("x_m"), height = numbers("height"), whole = numbers("a_b");
  for (std::size_t n = 0; n < count; ++n) {
    ASSERT_EQ(x_m[n], 500000.0 + static_cast<double>(n));
    ASSERT_EQ(height[n], static_cast<double>(n) + 0.5);
    ASSERT_EQ(std::isnan(svf[n]), n % 3 == 2) << n;
    ASSERT_TRUE(n % 3 == 2 || svf[n] == 0.25) << n;
    ASSERT_EQ(whole[n], n == 1 ? static_cast<double>(INT64_MIN) : static_cast<double>(n));
  }
  EXPECT_EQ(column("a_b")->GetNoDataValueAsInt64(), INT64_MIN);
}

TEST_F(CfPoints, SayWhatTheConventionsWantToKnow) {
  ASSERT_NE(root_, nullptr);
  EXPECT_EQ(std::string(root_->GetAttribute("featureType")->ReadAsString()), "point");
  EXPECT_EQ(std::string(root_->GetAttribute("Conventions")->ReadAsString()), "CF-1.8");
  EXPECT_EQ(std::string(root_->GetAttribute("source")->ReadAsString()), "Far-LoD 1");
  EXPECT_EQ(text("svf_low", "coordinates"), "x_m y_m z_m");
  EXPECT_EQ(text("svf_low", "grid_mapping"), "crs");
  EXPECT_THAT(text("svf_low", "long_name"), HasSubstr("lower bound"));
  EXPECT_EQ(text("x_m", "standard_name"), "projection_x_coordinate");
  EXPECT_EQ(text("crs", "grid_mapping_name"), "transverse_mercator");
  EXPECT_EQ(column("x_m")->GetUnit(), "m");
}

TEST_F(CfPoints, HaveTextsAsLongAsTheLongest) {
  ASSERT_NE(root_, nullptr);
  const auto ids = column("id");
  ASSERT_NE(ids, nullptr);
  for (const std::size_t n : {std::size_t{0}, std::size_t{16'384}, count - 1}) {
    char* id = nullptr;  // GDAL takes rows of characters for texts
    const std::vector<GUInt64> first{n};
    const std::vector<size_t> size{1};
    ASSERT_TRUE(ids->Read(first.data(), size.data(), nullptr, nullptr, GDALExtendedDataType::CreateString(), &id));
    EXPECT_EQ(std::string(id), id_of(n));
    CPLFree(id);
  }
  EXPECT_EQ(text("id", "_Encoding"), "utf-8");
}

TEST_F(CfPoints, HaveTheSameBytesEachTime) {
  const std::string bytes = scenes::text_of(folder_.file("p.nc"));
  const CfPoints_HaveTheSameBytesEachTime_Test again;
  EXPECT_TRUE(bytes == scenes::text_of(again.folder_.file("p.nc")));
  EXPECT_LT(bytes.size(), count * 30);
}

}  // namespace
}  // namespace farlod
