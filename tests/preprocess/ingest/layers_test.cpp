// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogrsf_frmts.h>

#include "farlod/error.hpp"
#include "reading.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "tree_reading.hpp"

namespace farlod::ingest::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A GeoPackage with a house in each of some layers.
std::filesystem::path geopackage(const std::filesystem::path& folder, const std::vector<std::string>& layers) {
  GDALAllRegister();
  const std::filesystem::path path = folder / "a.gpkg";
  const GDALDatasetUniquePtr dataset(
      GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  for (const std::string& name : layers) {
    OGRLayer* layer = dataset->CreateLayer(name.c_str(), nullptr, wkbPolygon, nullptr);
    OGRFieldDefn height("height", OFTReal);
    EXPECT_EQ(layer->CreateField(&height), OGRERR_NONE);
    OGRFeature house(layer->GetLayerDefn());
    house.SetField("height", 12.0);
    OGRGeometry* outline = nullptr;
    EXPECT_EQ(OGRGeometryFactory::createFromWkt("POLYGON((0 0,0 10,10 10,10 0,0 0))", nullptr, &outline), OGRERR_NONE);
    house.SetGeometryDirectly(outline);
    EXPECT_EQ(layer->CreateFeature(&house), OGRERR_NONE);
  }
  return path;
}

TEST(Layers, ThatAreNotReadAreNamed) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path file = geopackage(folder.path(), {"building", "building_part", "shed"});
  EXPECT_THAT(read_file(file).source.notes,
              ElementsAre(HasSubstr("only the layer building is read; --layer reads another: building_part, shed")));
  IngestSettings settings;
  settings.footprints.layer = "shed";
  EXPECT_THAT(read_file(file, settings).source.notes, IsEmpty()) << "the user knows";
  const scenes::TemporaryFolder other;
  EXPECT_THAT(read_file(geopackage(other.path(), {"building"})).source.notes, IsEmpty());
}

TEST(Layers, OfTreesAreReadByTheirNames) {
  const scenes::TemporaryFolder folder;
  const std::filesystem::path file = geopackage(folder.path(), {"park", "street"});
  TreeSettings settings;
  settings.layer = "street";
  const TreeReading reading = read_inventory(file, settings);
  EXPECT_EQ(reading.trees().size(), 1U);
  EXPECT_THAT(reading.detail_of(ProblemCode::unsupported_geometry), HasSubstr("that is street"));
  settings.layer = "lane";
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)read_inventory(file, settings); }),
              HasSubstr("has no layer \"lane\": give one of park, street as --trees-layer"));
}

}  // namespace
}  // namespace farlod::ingest::test
