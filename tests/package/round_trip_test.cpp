// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "farmap/far_map_baker.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "package/package_reader.hpp"
#include "package/package_writer.hpp"
#include "tests/package/small_package.hpp"
#include "tests/scenes/edges_as_set.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// What the one program writes is what the other reads.

namespace farlod {
namespace {

/// A half has 11 digits: it is off by at most half of the last.
constexpr float half_precision = 1.0F / 4096;
constexpr float smallest_half = 0x1p-24F;

FarMapSettings maps_of(FarMapKind kind) {
  if (kind == FarMapKind::box) return scenes::box_maps(8, 6);
  FarMapSettings settings;
  settings.horizon = {32, 2, 4, 0.05};
  return settings;
}

CityModel small_town() {
  scenes::SceneBuilder builder({3.0, -1.0, 12.0}, Angle::degrees(11));
  for (int n = 0; n < 6; ++n) builder.add_box({{30.0 * n, -20.0 + 9 * n}, {30.0 * n + 17, 6.0 + 9 * n}}, 0.5 * n, 8.0 + 4 * n);
  // A bridge, which is seen from under
  builder.add_box({{14.0, 5.0}, {120.0, 9.0}}, 15.0, 16.0);
  return builder.city();
}

/// The town as it was before it was written, and as it came back.
class RoundTrip : public testing::TestWithParam<Assign> {
 protected:
  RoundTrip() {
    for (const FarMapKind kind : {FarMapKind::box, FarMapKind::horizon})
      scenes::pack_city(town_, grid_, path_of(kind), maps_of(kind), GetParam());
  }
  [[nodiscard]] std::filesystem::path path_of(FarMapKind kind) const {
    return folder_.path() / (std::string(scenes::name_of(kind)) + ".farlod");
  }

  [[nodiscard]] TileSet tiles() const {
    Report report;
    return tiles::cut_into_tiles({town_, {}}, grid_, GetParam(), std::nullopt, report);
  }

  const CityModel town_ = small_town();
  const Grid grid_ = scenes::grid_covering(town_, Angle::degrees(20), 25.0, 3, 4);
  scenes::TemporaryFolder folder_;
};

TEST_P(RoundTrip, TheManifestKeepsThePlace) {
  const PackageReader package(path_of(FarMapKind::horizon));
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
  const PackageReader package(path_of(FarMapKind::horizon));
  for (std::size_t n = 0; n < before.tiles.size(); ++n) {
    const Tile& tile = before.tiles[n];
    const TileView view = package.tile(before.cells.cell_at(n));
    const std::span<const Point3f> vertices = view.mesh.vertices, old = tile.vertices;
    ASSERT_EQ(view.mesh.triangles.size(), tile.triangles.size());
    for (std::size_t t = 0; t < tile.triangles.size(); ++t) {
      const Triangle &read = view.mesh.triangles[t], &written = tile.triangles[t];
      EXPECT_EQ((std::array{vertices[read.a], vertices[read.b], vertices[read.c]}),
                (std::array{old[written.a], old[written.b], old[written.c]}));
    }
    EXPECT_EQ(view.cell->z_low_m, tile.z_low_m);
    EXPECT_EQ(view.cell->z_high_m, tile.z_high_m);
  }
}

TEST_P(RoundTrip, EdgesAreTheSame) {
  const TileSet before = tiles();
  const PackageReader package(path_of(FarMapKind::box));
  std::array<std::size_t, edge_role_count> edges{};
  std::size_t level = 0;
  for (std::size_t n = 0; n < before.tiles.size(); ++n) {
    const TileView view = package.tile(before.cells.cell_at(n));
    std::vector<HorizonEdge> read;
    view.visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
    EXPECT_EQ(scenes::edges_as_set(read), scenes::edges_as_set(before.tiles[n].horizon_edges));
    for (const HorizonEdge& e : read) ++edges.at(static_cast<std::size_t>(e.role));
    for (const HorizonEdge& e : read) level += e.adjacent.left == 0 || e.adjacent.right == 0 ? 1U : 0U;
  }
  EXPECT_GT(edges[static_cast<std::size_t>(EdgeRole::grounded)], 50U) << "the scene tests nothing";
  for (const EdgeRole role : {EdgeRole::overhang, EdgeRole::underside})
    EXPECT_GE(edges[static_cast<std::size_t>(role)], 4U) << "the scene tests nothing";
  EXPECT_GT(level, 10U) << "the scene tests nothing";
}

TEST_P(RoundTrip, VerticesOfATileDiffer) {
  const PackageReader package(path_of(FarMapKind::horizon));
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n) {
    const auto vertices = package.tile(grid_.cells.cell_at(n)).mesh.vertices;
    std::set<std::array<float, 3>> places;
    for (const Point3f& p : vertices) EXPECT_TRUE(places.insert({p.x, p.y, p.z}).second);
  }
}

TEST_P(RoundTrip, SurfacesAndBuildingsAreTheSame) {
  const TileSet before = tiles();
  const PackageReader package(path_of(FarMapKind::horizon));
  std::size_t grounded = 0, overhanging = 0;
  for (std::size_t n = 0; n < before.tiles.size(); ++n) {
    const Cell cell = before.cells.cell_at(n);
    const BlockTiles& block = package.block_tiles(cell);
    const TileView view = block.tile(cell);
    for (std::uint32_t t = 0; t < view.mesh.triangles.size(); ++t) {
      const Surface& surface = before.surfaces[before.tiles[n].triangle_surfaces[t]];
      const package::SurfaceRecord& record = view.surface_of(t);
      EXPECT_EQ(view.building_number(record), surface.building);
      EXPECT_EQ(std::pair(record.number, record.part), std::pair(surface.number, surface.part));
      EXPECT_EQ(record.kind(), surface.kind);
      EXPECT_EQ(record.is_grounded(), surface.grounded);
      ++(record.is_grounded() ? grounded : overhanging);
      EXPECT_EQ(record.normal(), package::OctNormal::nearest_to(surface.normal));
      if (record.building == package::no_building) continue;
      EXPECT_EQ(block.id_of(view.buildings[record.building]), before.building_ids[surface.building]);
    }
  }
  EXPECT_GT(grounded, 50U) << "the scene tests nothing";
  EXPECT_GT(overhanging, 10U) << "the scene tests nothing";
}

TEST_P(RoundTrip, BoxMapsAreTheSameToHalfPrecision) {
  const TileSet before = tiles();
  const FarMapBaker baker(before, grid_, GetParam(), maps_of(FarMapKind::box));
  const PackageReader package(path_of(FarMapKind::box));
  std::size_t blocked = 0;
  for (const Block block : grid_.blocks()) {
    const auto maps = std::get<BakedBoxes>(baker.bake(block));
    for (std::size_t n = 0; n < maps.size(); ++n) {
      const Cell cell = grid_.cells_of(block).cell_at(n);
      const BoxFarMap map = package.box_far_map(cell);
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

/// What names are worth: rows may be numbered anew, edges stay.
void expect_same_names(std::span<const package::ExplicitOccluder> a, std::span<const HorizonEdge> of_a,
                       std::span<const package::ExplicitOccluder> b, std::span<const HorizonEdge> of_b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(of_a[a[n].row], of_b[b[n].row]);
    EXPECT_EQ(std::pair(a[n].squares, a[n].layers), std::pair(b[n].squares, b[n].layers));
  }
}

TEST_P(RoundTrip, WhatHorizonsNameIsTheSame) {
  const TileSet before = tiles();
  const FarMapBaker baker(before, grid_, GetParam(), maps_of(FarMapKind::horizon));
  const PackageReader package(path_of(FarMapKind::horizon));
  std::array<std::size_t, edge_role_count> edges{};
  for (const Block block : grid_.blocks()) {
    const auto maps = std::get<BakedHorizons>(baker.bake(block));
    const CellRange cells = grid_.cells_of(block);
    for (std::size_t n = 0; n < maps.cells.size(); ++n) {
      const FarHorizon map = package.far_horizon(cells.cell_at(n));
      EXPECT_EQ(map.patches.levels_m(), maps.cells[n].patches.levels_m());
      EXPECT_EQ(map.patches.squares_per_edge(), maps.cells[n].patches.squares_per_edge());
      expect_same_names(map.occluders.explicit_edges, map.occluders.edges, maps.cells[n].explicit_edges, maps.edges);
      EXPECT_EQ(map.occluders.cell_from_block_m, grid_.corner_of(cells.cell_at(0)) - grid_.corner_of(cells.cell_at(n)));
      for (const package::ExplicitOccluder& occluder : map.occluders.explicit_edges)
        ++edges.at(static_cast<std::size_t>(map.occluders.edges[occluder.row].role));
    }
  }
  EXPECT_GT(edges[static_cast<std::size_t>(EdgeRole::grounded)], 100U) << "the scene tests nothing";
  for (const EdgeRole role : {EdgeRole::overhang, EdgeRole::underside})
    EXPECT_GT(edges[static_cast<std::size_t>(role)], 10U) << "the scene tests nothing";
}

TEST_P(RoundTrip, SlopesAreRoundedOutwardsToHalfPrecision) {
  const TileSet before = tiles();
  const FarMapBaker baker(before, grid_, GetParam(), maps_of(FarMapKind::horizon));
  const PackageReader package(path_of(FarMapKind::horizon));
  std::size_t uncertain = 0, overhung = 0;
  for (const Block block : grid_.blocks()) {
    const auto maps = std::get<BakedHorizons>(baker.bake(block));
    for (std::size_t n = 0; n < maps.cells.size(); ++n) {
      const FarHorizon read = package.far_horizon(grid_.cells_of(block).cell_at(n));
      const BakedHorizon& written = maps.cells[n];
      ASSERT_EQ(read.high.size(), written.high.size());
      for (std::size_t k = 0; k < written.high.size(); ++k) {
        EXPECT_LE(read.low[k], written.low[k]);
        EXPECT_GE(read.high[k], written.high[k]);
        EXPECT_GE(read.overhang[k], written.overhang[k]);
        // Outwards, by one of the last digits of a half at the most
        EXPECT_NEAR(read.low[k], written.low[k], 4 * half_precision * written.low[k] + smallest_half);
        EXPECT_NEAR(read.high[k], written.high[k], 4 * half_precision * written.high[k] + smallest_half);
        EXPECT_NEAR(read.overhang[k], written.overhang[k], 4 * half_precision * written.overhang[k] + smallest_half);
        EXPECT_NEAR(read.estimate[k], written.estimate[k], 2 * half_precision * written.estimate[k] + smallest_half);
        uncertain += written.high[k] > written.low[k] ? 1U : 0U;
        overhung += written.overhang[k] > 0.0F ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(uncertain, 100U) << "the scene tests nothing";
  EXPECT_GT(overhung, 10U) << "the scene tests nothing";
}

INSTANTIATE_TEST_SUITE_P(All, RoundTrip, testing::Values(Assign::clip, Assign::whole),
                         [](const auto& test) { return test.param == Assign::clip ? "Clip" : "Whole"; });

// A package that is tried out in memory answers as it will from the disk.

CityModel town() {
  CitySettings settings{.size_m = 250, .seed = 5, .tower_share = 0.5, .overhangs = true};
  return scenes::generated_town(settings);
}

class InMemory : public testing::Test {
 protected:
  InMemory() { scenes::pack_tiles(tiles_, grid_, folder_, {}); }

  [[nodiscard]] static TileSet cut(const CityModel& city, const Grid& grid) {
    Report ignored;
    return tiles::cut_into_tiles({city, {}}, grid, Assign::clip, {}, ignored);
  }
  [[nodiscard]] PackageInMemory contents_of(const PackageReader& disk) {
    PackageInMemory memory{disk.manifest(), {}, {}};
    for (const Block block : grid_.blocks())
      bytes_.push_back(bytes_of(folder_ / package::block_folder(block) / package::tiles_file));
    for (const Bytes& bytes : bytes_) memory.tiles.emplace_back(bytes);
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); ++n)
      memory.far_horizons.emplace(grid_.cells.cell_at(n), disk.far_horizon(grid_.cells.cell_at(n)));
    return memory;
  }
  [[nodiscard]] std::vector<float> answers_of(const PackageReader& package, Engine engine) const {
    const SkyEvaluator evaluator(package, {engine, SkyWeight::cosine, 145});
    std::vector<float> all;
    for (std::size_t n = 0; n < static_cast<std::size_t>(grid_.cells.size()); n += 5) {
      CellReceivers receivers{grid_.cells.cell_at(n), {}};
      for (const float x : {1.0F, 11.0F, 26.0F}) receivers.receivers.push_back({receivers.receivers.size(), {x, 17.0F, 3.0F}});
      std::vector<float> svf(3), low(3), high(3);
      evaluator.evaluate(receivers, SkyAnswers(svf, low, high));
      for (const auto& some : {svf, low, high}) all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  CityModel city_ = town();
  Grid grid_ = scenes::grid_covering(city_, Angle::degrees(4), 30.0, 3, 4);
  TileSet tiles_ = cut(city_, grid_);
  scenes::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "town.farlod";
  std::vector<Bytes> bytes_;
};

TEST_F(InMemory, AnswersAreThoseFromTheDisk) {
  const PackageReader disk(folder_);
  const PackageReader memory(contents_of(disk));
  for (const Engine engine : {Engine::automatic, Engine::rays, Engine::exact}) {
    const std::vector<float> answers = answers_of(memory, engine);
    EXPECT_EQ(answers, answers_of(disk, engine));
    EXPECT_GT(std::count_if(answers.begin(), answers.end(), [](float svf) { return svf > 0.0F && svf < 1.0F; }), 10);
  }
}

TEST_F(InMemory, DamagedTilesAreRefusedAsOnTheDisk) {
  const PackageReader disk(folder_);
  PackageInMemory contents = contents_of(disk);
  contents.tiles.front() = contents.tiles.front().first(100);
  const PackageReader memory(std::move(contents));
  EXPECT_THROW((void)memory.tile(grid_.cells.cell_at(0)), PackageDamaged);
}

TEST_F(InMemory, SlopesComeBackAsTheyAreRounded) {
  const PackageReader disk(folder_);
  const HorizonMapBaker baker(tiles_, grid_, {});
  std::size_t changed = 0;
  for (const Block block : grid_.blocks()) {
    BakedHorizons baked = baker.bake(block);
    for (std::size_t n = 0; n < baked.cells.size(); ++n) {
      BakedHorizon& map = baked.cells[n];
      const std::vector<float> exact = map.high;
      round_as_stored(map);
      changed += map.high != exact ? 1 : 0;
      const FarHorizon read = disk.far_horizon(grid_.cells_of(block).cell_at(n));
      EXPECT_EQ(read.low, map.low);
      EXPECT_EQ(read.estimate, map.estimate);
      EXPECT_EQ(read.high, map.high);
      EXPECT_EQ(read.overhang, map.overhang);
    }
  }
  EXPECT_GT(changed, 0U) << "the test would test nothing";
}

}  // namespace
}  // namespace farlod
