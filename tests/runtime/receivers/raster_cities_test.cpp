// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "align/align.hpp"
#include "georeference/georeference.hpp"
#include "ingest/files/input_search.hpp"
#include "ingest/ingest.hpp"
#include "receivers/raster_receivers.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/test_data.hpp"
#include "tiles/tiles.hpp"

// Pixels are placed all at once, triangle by triangle. The judge looks at each of them alone.

namespace farlod {
namespace {

std::map<std::size_t, Point3f> one_by_one(const PackageReader& package, const RasterPlan& plan, const PixelRange& range,
                                          Cell cell, HeightAbove above) {
  const PointLocator locator(package, cell);
  std::map<std::size_t, Point3f> result;
  for (std::size_t row = range.row_begin; row < range.row_end; ++row)
    for (std::size_t column = range.column_begin; column < range.column_end; ++column) {
      const Point2d p_grid = package.manifest().grid_from_projected(plan.centre_m(column, row));
      if (package.grid().cell_of(p_grid) != cell) continue;
      const Point2d p = p_grid - package.grid().corner_of(cell);
      if (const auto standing = stand(locator, static_cast<float>(p.x), static_cast<float>(p.y), above, 1.5F))
        result[row * plan.columns + column] = *standing;
    }
  return result;
}

/// Returns the number of receivers.
std::size_t expect_as_one_by_one(const PackageReader& package, double step_m) {
  const RasterPlan plan = plan_raster(package.manifest(), step_m, std::nullopt);
  const RasterReceivers receivers(package.manifest(), plan);
  std::size_t count = 0;
  for (const Cell cell : receivers.cells())
    for (const HeightAbove above : {HeightAbove::ground, HeightAbove::highest_surface}) {
      std::map<std::size_t, Point3f> found;
      for (const Receiver& r : receivers.in_cell(package, cell, above, 1.5F).receivers) found.emplace(r.index, r.p_cell);
      EXPECT_EQ(found, one_by_one(package, plan, receivers.range_of(cell), cell, above)) << cell.i << "," << cell.j;
      count += found.size();
    }
  return count;
}

struct Town {
  const char* name;
  CitySettings settings;
};
void PrintTo(const Town& town, std::ostream* out) { *out << town.name; }

Town town(const char* name, const std::function<void(CitySettings&)>& change) {
  CitySettings settings;
  settings.size_m = 220.0;
  settings.seed = 5;
  settings.rotation_deg = 33.0;
  change(settings);
  return {name, settings};
}

class RasterOfGeneratedTown : public testing::TestWithParam<Town> {};

TEST_P(RasterOfGeneratedTown, HasTheReceiversOfSinglePlaces) {
  const CityModel city = scenes::generated_town(GetParam().settings);
  for (const Assign assign : {Assign::clip, Assign::whole}) {
    const scenes::TemporaryFolder folder;
    const Grid grid = scenes::grid_covering(city, Angle::degrees(33.0), 40.0, 1);
    scenes::pack_city(city, grid, folder.path() / "town.farlod", scenes::box_maps(1, 1), assign);
    const PackageReader package(folder.path() / "town.farlod");
    EXPECT_GT(expect_as_one_by_one(package, 1.0), 30'000U);
    EXPECT_GT(expect_as_one_by_one(package, 7.3), 500U);
  }
}

INSTANTIATE_TEST_SUITE_P(Towns, RasterOfGeneratedTown,
                         testing::Values(town("Prisms", [](CitySettings& s) { s.lod = 1; }),
                                         town("Roofs",
                                              [](CitySettings& s) {
                                                s.lod = 2;
                                                s.eaves_m = 0.5;
                                                s.balconies = s.projecting_floors = s.overhangs = true;
                                              }),
                                         town("OpenShells", [](CitySettings& s) { s.open_shells = s.overhangs = true; }),
                                         town("Hillside", [](CitySettings& s) { s.hillside = s.overlapping_parts = true; }),
                                         town("Details",
                                              [](CitySettings& s) {
                                                s.lod = 2;
                                                s.terrain_relief_m = 30.0;
                                                s.facade_details = true;
                                                s.wrong_base_share = 0.2;
                                              })),
                         [](const auto& town) { return town.param.name; });

class RasterOfRealCity : public testing::TestWithParam<const char*> {};

TEST_P(RasterOfRealCity, HasTheReceiversOfSinglePlaces) {
  const std::filesystem::path file = scenes::test_data(GetParam());
  if (!std::filesystem::exists(file)) GTEST_SKIP() << scenes::absence_of(file);
  const scenes::TemporaryFolder folder;
  Report report;
  const std::vector inputs{file};
  LocatedCity located = georeference::georeference(ingest::ingest_all(ingest::find_input_files(inputs, report).files, {}, report),
                                                   georeference::GeoreferenceSettings(), report);
  const Grid grid = align::align(located, {}, report).grid;
  const TileSet tiles = tiles::cut_into_tiles(std::move(located), grid, Assign::clip, std::nullopt, report);
  scenes::pack_tiles(tiles, grid, folder.path() / "city.farlod", scenes::box_maps(1, 1));
  const PackageReader package(folder.path() / "city.farlod");
  EXPECT_GT(expect_as_one_by_one(package, 2.0), 10'000U);
}

INSTANTIATE_TEST_SUITE_P(Cities, RasterOfRealCity,
                         testing::Values("rotterdam/delfshaven.city.json", "tokyo/53392633_bldg_6697_2_op.gml"),
                         [](const auto& city) { return city.index == 0 ? "Rotterdam" : "Tokyo"; });

}  // namespace
}  // namespace farlod
