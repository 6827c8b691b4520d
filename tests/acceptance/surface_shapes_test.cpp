// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <string>

#include "tests/acceptance/packed_town.hpp"

// The geometry of surfaces, read back by GDAL.

namespace farlod::acceptance {
namespace {

/// Each coordinate is rounded to the millimetre; so is a length.
constexpr double rounding_m = 0.002;

GDALDatasetUniquePtr opened(const std::filesystem::path& path) {
  GDALAllRegister();
  return GDALDatasetUniquePtr(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
}

Point3d double_area_of(const OGRLinearRing& ring) {
  Point3d sum{};
  const auto at = [&](int k) { return Point3d{ring.getX(k), ring.getY(k), ring.getZ(k)}; };
  for (int k = 0; k + 1 < ring.getNumPoints(); ++k) sum = sum + cross(at(k) - at(0), at(k + 1) - at(0));
  return sum;
}

/// The area of flat polygons in space.
double area_of(const OGRMultiPolygon& polygons) {
  double area = 0.0;
  for (const OGRPolygon* polygon : polygons) {
    Point3d sum{};
    for (const OGRLinearRing* ring : *polygon) sum = sum + double_area_of(*ring);
    area += 0.5 * norm(sum);
  }
  return area;
}

void expect_shapes(OGRLayer& layer) {
  EXPECT_EQ(layer.GetGeomType(), wkbMultiPolygon25D);
  EXPECT_STREQ(layer.GetSpatialRef()->GetAuthorityCode(nullptr), "32632");
  EXPECT_EQ(layer.GetFeatureCount(), static_cast<GIntBig>(5 * small_town().size()));
  for (const auto& feature : layer) {
    const OGRMultiPolygon& polygons = *feature->GetGeometryRef()->toMultiPolygon();
    // Cells cut each wall, and none of them shows
    EXPECT_EQ(polygons.getNumGeometries(), 1);
    const double area_m2 = feature->GetFieldAsDouble("area_m2") + feature->GetFieldAsDouble("covered_area_m2");
    EXPECT_NEAR(area_of(polygons), area_m2, rounding_m * 4.0 * tower_height_m) << feature->GetFieldAsString("building");
    OGREnvelope3D around;
    polygons.getEnvelope(&around);
    const bool is_roof = std::string(feature->GetFieldAsString("kind")) == "roof";
    EXPECT_EQ(around.MaxZ - around.MinZ < rounding_m, is_roof);
    EXPECT_NEAR(around.MinX, town_middle.x, 2.0 * town_half_m);
    EXPECT_NEAR(around.MinY, town_middle.y, 2.0 * town_half_m);
  }
}

TEST_F(PackedTown, SurfacesHaveTheirPolygonsInAGeoPackage) {
  folder.must("farlod-svf a.farlod -o o.gpkg --surfaces all --spacing 12 --azimuths 16");
  const auto file = opened(folder.path("o.gpkg"));
  ASSERT_NE(file, nullptr);
  expect_shapes(*file->GetLayerByName("surfaces"));
  EXPECT_EQ(file->GetLayerByName("buildings")->GetGeomType(), wkbNone);
  EXPECT_THAT(folder.names(), testing::Not(testing::Contains(testing::HasSubstr("shapes"))));
}

TEST_F(PackedTown, SurfacesHaveTheirPolygonsBesideFormatsOfOneLayer) {
  folder.must("farlod-svf a.farlod -o o.fgb --surfaces all --spacing 12 --azimuths 16");
  const auto file = opened(folder.path("o.surfaces.fgb"));
  ASSERT_NE(file, nullptr);
  expect_shapes(*file->GetLayer(0));
  EXPECT_TRUE(std::filesystem::exists(folder.path("o.buildings.csv")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("o.surfaces.csv")));
}

TEST_F(PackedTown, SurfacesInGeoJsonLieWhereTheTownDoes) {
  folder.must("farlod-svf a.farlod -o o.geojson --surfaces roofs --spacing 12 --azimuths 16");
  const auto file = opened(folder.path("o.surfaces.geojson"));
  ASSERT_NE(file, nullptr);
  OGRLayer& layer = *file->GetLayerByName("surfaces");
  ASSERT_EQ(layer.GetFeatureCount(), static_cast<GIntBig>(small_town().size()));
  constexpr double metres_of_degree = 111'000.0;
  double area = 0.0, expected = 0.0;
  for (const auto& feature : layer) {
    const OGRMultiPolygon& polygons = *feature->GetGeometryRef()->toMultiPolygon();
    OGREnvelope3D around;
    polygons.getEnvelope(&around);
    EXPECT_NEAR(around.MinX, 9.0, 2.0 * town_half_m / metres_of_degree);
    EXPECT_GT(around.MinZ, 0.0);
    // Counter-clockwise, as RFC 7946 has it
    const double latitude = around.MinY * M_PI / 180.0;
    for (const OGRPolygon* polygon : polygons) {
      EXPECT_EQ(polygon->getExteriorRing()->isClockwise(), 0);
      area += polygon->get_Area() * metres_of_degree * metres_of_degree * std::cos(latitude);
    }
    expected += feature->GetFieldAsDouble("area_m2");
  }
  EXPECT_NEAR(area / expected, 1.0, 0.02);
}

}  // namespace
}  // namespace farlod::acceptance
