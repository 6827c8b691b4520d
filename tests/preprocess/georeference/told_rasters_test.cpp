// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <ogr_spatialref.h>

#include <array>
#include <span>
#include <string>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/georeference.hpp"
#include "georeference/raster_reader.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

// What is said of where a raster lies, and of the unit in which it counts.

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ToldRasters : public testing::Test {
 protected:
  void SetUp() override { GDALAllRegister(); }

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_.file(name); }
  /// 50 × 50 pixels of 30.
  [[nodiscard]] GDALDatasetUniquePtr new_raster(const std::string& name, int epsg, std::array<double, 6> transform) const {
    GDALDatasetUniquePtr dataset(
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(file(name).c_str(), 50, 50, 1, GDT_Float32, nullptr));
    OGRSpatialReference crs;
    EXPECT_EQ(crs.importFromEPSG(epsg), OGRERR_NONE);
    dataset->SetSpatialRef(&crs);
    dataset->SetGeoTransform(transform.data());
    dataset->GetRasterBand(1)->Fill(30.0);
    return dataset;
  }

  Report report;

 private:
  scenes::TemporaryFolder folder_;
};

TEST_F(ToldRasters, LieWhereTheCityIsWithExchangedDegrees) {
  new_raster("rotterdam.tif", 32631, {600000.0, 100.0, 0.0, 5755000.0, 0.0, -100.0}).reset();
  const auto off_somalia =
      CrsTransformation(*Crs::find("EPSG:4326"), *Crs::find("EPSG:32639"), {51.92, 4.47}).apply({51.92, 4.47});
  ASSERT_TRUE(off_somalia);
  Box2d wanted;
  wanted.add({0.0, 0.0});
  const auto message = [&](Point2d place) {
    const Georeference city = georeference_around(place, *Crs::find("EPSG:32639"));
    return scenes::refusal_of<InputError>([&] { (void)read_terrain(file("rotterdam.tif"), "", city, wanted, report); });
  };
  EXPECT_THAT(message(*off_somalia), HasSubstr("with latitude and longitude exchanged, at 51.92° N, 4.47° E instead of 4.47° N, "
                                               "51.92° E: are they exchanged in its files?"));
  EXPECT_THAT(message(*off_somalia + Point2d{50e3, 0.0}), HasSubstr("Is one of the two CRSs wrong"));
}

TEST_F(ToldRasters, AreInFeetThatOnlyTheMapTells) {
  const auto notes_of = [&](int code, const std::string& unit) {
    const auto dataset = new_raster("dsm.tif", code, {990000.0, 3.0, 0.0, 220000.0, 0.0, -3.0});
    if (!unit.empty()) dataset->GetRasterBand(1)->SetUnitType(unit.c_str());
    dataset->FlushCache();
    const TerrainFile terrain(file("dsm.tif"));
    const Georeference city = georeference_of_terrain(terrain, {}, report);
    const auto surface = read_turned_surface(terrain, "", city, report);
    return surface ? surface->notes : read_terrain(std::span(&terrain, 1), "", city, std::nullopt, report).notes;
  };
  EXPECT_THAT(notes_of(2263, ""), Contains(AllOf(HasSubstr("taken for US survey feet"), HasSubstr("gdal_edit.py -units m"))));
  EXPECT_THAT(notes_of(2263, "m"), Not(Contains(HasSubstr("taken for"))));
  EXPECT_THAT(notes_of(32118, ""), IsEmpty());
}

}  // namespace
}  // namespace farlod::georeference
