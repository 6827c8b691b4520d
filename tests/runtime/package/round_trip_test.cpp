// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "package/package.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// What the one program writes is what the other reads.

namespace farlod {
namespace {

/// A half has 11 digits: it is off by at most half of the last.
constexpr float half_precision = 1.0F / 4096;
constexpr FarMapSettings map_settings{8, 6, 1.5};

CityModel small_town() {
  scenes::SceneBuilder builder({3.0, -1.0, 12.0}, Angle::degrees(11));
  for (int n = 0; n < 6; ++n) builder.add_box({{30.0 * n, -20.0 + 9 * n}, {30.0 * n + 17, 6.0 + 9 * n}}, 0.5 * n, 8.0 + 4 * n);
  return builder.city();
}

/// The town as it was before it was written, and as it came back.
class RoundTrip : public testing::TestWithParam<Assign> {
 protected:
  RoundTrip() { scenes::pack_city(town_, grid_, folder_.path() / "town.farlod", map_settings, GetParam()); }

  [[nodiscard]] TileSet tiles() const {
    Report report;
    return cut_into_tiles({town_, {}}, grid_, GetParam(), std::nullopt, report);
  }

  const CityModel town_ = small_town();
  const Grid grid_ = scenes::grid_covering(town_, Angle::degrees(20), 25.0, 3, 4);
  scenes::TemporaryFolder folder_;
};

TEST_P(RoundTrip, TheManifestKeepsThePlace) {
  const Package package(folder_.path() / "town.farlod");
  EXPECT_EQ(package.grid().cells, grid_.cells);
  EXPECT_EQ(package.grid().cell_edge_m, grid_.cell_edge_m);
  EXPECT_EQ(package.grid().neighborhood, grid_.neighborhood);
  EXPECT_EQ(package.grid().block_edge, grid_.block_edge);
  EXPECT_EQ(package.manifest().height_origin_m, tiles().height_origin_m);
  EXPECT_EQ(package.manifest().buildings, town_.buildings().size());
  EXPECT_EQ(package.manifest().assign, GetParam() == Assign::clip ? "clip" : "whole");
  // Degrees on disk, radians in memory: two roundings
  EXPECT_NEAR(package.grid().rotation.bearing().degrees(), 20.0, 20.0 * 4 * std::numeric_limits<double>::epsilon());
}

TEST_P(RoundTrip, TilesAreTheSame) {
  const TileSet before = tiles();
  const Package package(folder_.path() / "town.farlod");
  for (std::size_t n = 0; n < before.tiles.size(); ++n) {
    const Tile& tile = before.tiles[n];
    const TileView view = package.tile(before.cells.cell_at(n));
    EXPECT_TRUE(std::equal(tile.vertices.begin(), tile.vertices.end(), view.mesh.vertices.begin(), view.mesh.vertices.end()));
    EXPECT_TRUE(std::equal(tile.triangles.begin(), tile.triangles.end(), view.mesh.triangles.begin(), view.mesh.triangles.end()));
    EXPECT_EQ(view.cell->flags & package::cell_has_overhang, tile.has_overhang ? package::cell_has_overhang : 0);
    EXPECT_EQ(view.cell->z_low_m, tile.z_low_m);
    EXPECT_EQ(view.cell->z_high_m, tile.z_high_m);
  }
}

TEST_P(RoundTrip, SurfacesAndBuildingsAreTheSame) {
  const TileSet before = tiles();
  const Package package(folder_.path() / "town.farlod");
  for (std::size_t n = 0; n < before.tiles.size(); ++n) {
    const Cell cell = before.cells.cell_at(n);
    const BlockTiles& block = package.block_tiles(cell);
    const TileView view = block.tile(cell);
    for (std::uint32_t t = 0; t < view.mesh.triangles.size(); ++t) {
      const Surface& surface = before.surfaces[before.tiles[n].triangle_surfaces[t]];
      const package::SurfaceRecord& record = view.surface_of(t);
      EXPECT_EQ(view.building_number(record), surface.building);
      EXPECT_EQ(std::pair(record.number, record.part), std::pair(surface.number, surface.part));
      EXPECT_EQ(record.kind, surface.kind);
      EXPECT_EQ((Point3f{record.normal_x, record.normal_y, record.normal_z}),
                (Point3f{static_cast<float>(surface.normal.x), static_cast<float>(surface.normal.y),
                         static_cast<float>(surface.normal.z)}));
      EXPECT_EQ(record.area_m2, static_cast<float>(surface.area_m2));
      if (record.building == package::no_building) continue;
      EXPECT_EQ(block.id_of(view.buildings[record.building]), before.building_ids[surface.building]);
    }
  }
}

TEST_P(RoundTrip, FarMapsAreTheSameToHalfPrecision) {
  const TileSet before = tiles();
  const BoxMapBaker baker(before, grid_, GetParam(), map_settings);
  const Package package(folder_.path() / "town.farlod");
  std::size_t blocked = 0;
  for (const Block block : grid_.blocks()) {
    const std::vector<BakedMap> maps = baker.bake(block);
    for (std::size_t n = 0; n < maps.size(); ++n) {
      const Cell cell = grid_.cells_of(block).cell_at(n);
      const FarMap map = package.far_map(cell);
      EXPECT_EQ(package.tile(cell).cell->far_map_top, maps[n].shape.top);
      EXPECT_EQ(package.tile(cell).cell->capture_z_m, maps[n].capture_cell.z);
      for (std::size_t k = 0; k < maps[n].distance_m.size(); ++k) {
        const BoxMap& shape = maps[n].shape;
        const Texel texel{static_cast<std::uint32_t>(k % shape.columns()), static_cast<std::uint32_t>(k / shape.columns())};
        const float written = maps[n].distance_m[k], read = map.distance_m(shape.direction_of(texel));
        EXPECT_EQ(std::isinf(written), std::isinf(read));
        if (std::isinf(written)) continue;
        EXPECT_NEAR(read, written, half_precision * 2 * written);
        ++blocked;
      }
    }
  }
  EXPECT_GT(blocked, 100U) << "the scene tests nothing";
}

INSTANTIATE_TEST_SUITE_P(All, RoundTrip, testing::Values(Assign::clip, Assign::whole),
                         [](const auto& test) { return test.param == Assign::clip ? "Clip" : "Whole"; });

}  // namespace
}  // namespace farlod
