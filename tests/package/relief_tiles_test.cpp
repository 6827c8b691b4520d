// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/relief_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "farmap/far_map_baker.hpp"
#include "package/package_reader.hpp"
#include "package/package_writer.hpp"
#include "tests/scenes/edges_as_set.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod {
namespace {

using tiles::SquaresOfReaders;

/// Hills with noise; where asked for, with a pond, a hole, and a rock that stands upright.
struct Hills {
  const char* name;
  double turn_deg = 0.0, pixel_m = 1.0;
  float lowest_m = 100.0F;
  bool is_broken = false;
};
void PrintTo(const Hills& hills, std::ostream* out) { *out << hills.name; }

TerrainRaster raster_of(const Hills& hills) {
  TerrainRaster raster;
  raster.first = {3.25, -20.75};
  raster.step_m = {hills.pixel_m, hills.pixel_m};
  raster.columns = 45;
  raster.rows = 38;
  raster.covers_pixels = true;
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0.0F, 0.05F);
  for (std::size_t n = 0; n < raster.columns * raster.rows; ++n) {
    const auto x = static_cast<float>(n % raster.columns), y = static_cast<float>(n / raster.columns);
    raster.height_m.emplace_back(hills.lowest_m + 3.0F * std::sin(0.2F * x) * std::cos(0.17F * y) + 0.05F * x + noise(random));
  }
  if (!hills.is_broken) return raster;
  for (std::size_t row = 4; row < 9; ++row)
    for (std::size_t column = 30; column < 37; ++column) raster.height_m[row * raster.columns + column] = hills.lowest_m - 4.0F;
  for (std::size_t column = 5; column < 8; ++column) raster.height_m[20 * raster.columns + column].reset();
  raster.height_m[11 * raster.columns + 12] = hills.lowest_m + 14.0F;
  return raster;
}

Grid grid_over(const Hills& hills) {
  Grid grid;
  grid.rotation = GridRotation(Angle::degrees(hills.turn_deg));
  grid.cell_edge_m = exact_cell_edge_m(12.0 * hills.pixel_m);
  grid.block_edge = 2;
  grid.cells = {-2, -4, 7, 6};
  return grid;
}

/// Hills, cut; their tiles here have all squares, those of readers last.
struct CutHills {
  explicit CutHills(const Hills& hills, bool are_left_out = true) : raster(raster_of(hills)), grid(grid_over(hills)) {
    Report report;
    const auto on_ground = [&](tiles::Ground& ground, double height_origin_m) {
      const std::uint64_t count =
          are_left_out ? ground.leave_out_squares(grid, SquaresOfReaders::behind, [](std::uint64_t) { return true; }) : 0;
      for (const auto& height_m : raster.height_m)
        heights.height_m.push_back(height_m ? static_cast<float>(*height_m - height_origin_m)
                                            : std::numeric_limits<float>::quiet_NaN());
      heights.joined.assign(ground.pixel_steps().joined().begin(), ground.pixel_steps().joined().end());
      if (count > 0) heights.in_grid = tiles::pixels_in_grid(raster, grid.rotation);
      return count;
    };
    tiles = tiles::cut_into_tiles({}, grid, Assign::clip, raster, report, {}, on_ground);
  }

  /// A package without far maps.
  void write(const std::filesystem::path& folder) const {
    package::Manifest m;
    m.software = "test";
    m.height_origin_m = tiles.height_origin_m;
    m.grid = grid;
    m.assign = "clip";
    m.far_map = shape_of(FarMapSettings{});
    m.triangles = tiles.triangle_count();
    PackageWriter writer(folder);
    for (const Block block : grid.blocks())
      m.blocks.push_back(writer.write_block(tiles, BakedBlock{}, grid, block, m.far_map, package::CellRuns{}));
    const auto columns = static_cast<std::uint32_t>(raster.columns), rows = static_cast<std::uint32_t>(raster.rows);
    m.pixels = package::SurfacePixels{
        {raster.first.x - 0.5 * raster.step_m.x, raster.first.y + (static_cast<double>(rows) - 0.5) * raster.step_m.y},
        raster.step_m.x,
        columns,
        rows};
    m.pixels->walls = 0;
    if (tiles.squares_of_readers > 0) m.pixels->squares = tiles.squares_of_readers;
    m.pixels->heights = write_pixel_heights(folder, *m.pixels, heights);
    writer.write_manifest(m);
  }

  TerrainRaster raster;
  Grid grid;
  PixelHeights heights;
  TileSet tiles;
};

using Corner = std::array<float, 3>;
using Corners = std::array<Corner, 3>;

/// The triangles of a mesh, whatever their order, and with whichever corner they begin.
std::vector<Corners> triangles_as_set(const MeshView& mesh) {
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3f& p = mesh.vertices[t.corner(k)];
      corners[k] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

class ReliefTilesOf : public testing::TestWithParam<Hills> {
 protected:
  ReliefTilesOf() { cut_.write(folder_); }

  scenes::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "hills.farlod";
  CutHills cut_{GetParam()};
};

TEST_P(ReliefTilesOf, HaveTheTrianglesOfTheCutSurface) {
  const PackageReader package(folder_);
  std::size_t made = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cut_.grid.cells.size()); ++n) {
    const Cell cell = cut_.grid.cells.cell_at(n);
    const TileView view = package.tile(cell);
    EXPECT_EQ(triangles_as_set(view.mesh), triangles_as_set(cut_.tiles.tile(cell).mesh())) << n;
    made += view.mesh.triangles.size() - package.block_tiles(cell).tile(cell).mesh.triangles.size();
  }
  EXPECT_EQ(made, 2 * cut_.tiles.squares_of_readers);
  EXPECT_GT(made, cut_.tiles.triangle_count() / 3);
}

TEST_P(ReliefTilesOf, HaveTheEdgesOfTheCutSurface) {
  const PackageReader package(folder_);
  for (std::size_t n = 0; n < static_cast<std::size_t>(cut_.grid.cells.size()); ++n) {
    std::vector<HorizonEdge> read;
    package.tile(cut_.grid.cells.cell_at(n)).visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
    EXPECT_EQ(scenes::edges_as_set(read), scenes::edges_as_set(cut_.tiles.tiles[n].horizon_edges)) << n;
  }
}

TEST_P(ReliefTilesOf, TellWhatATileTells) {
  const PackageReader package(folder_);
  for (std::size_t n = 0; n < static_cast<std::size_t>(cut_.grid.cells.size()); ++n) {
    const TileView view = package.tile(cut_.grid.cells.cell_at(n));
    const auto& [vertices, triangles, held] = view.mesh;
    ASSERT_EQ(view.cell->triangle_count, triangles.size());
    ASSERT_EQ(view.cell->vertex_count, vertices.size());
    if (triangles.empty()) continue;
    const auto [low, high] =
        std::minmax_element(vertices.begin(), vertices.end(), [](const Point3f& a, const Point3f& b) { return a.z < b.z; });
    EXPECT_EQ(view.cell->z_low_m, low->z);
    EXPECT_EQ(view.cell->z_high_m, high->z);
    EXPECT_EQ(view.surface_runs.back().end, triangles.size());
    EXPECT_EQ(view.surface_of(static_cast<std::uint32_t>(triangles.size() - 1)).kind(), SurfaceKind::ground);
    std::vector<Corner> places;
    for (const Point3f& p : vertices) places.push_back({p.x, p.y, p.z});
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << "a vertex is there twice";
  }
}

TEST_P(ReliefTilesOf, AnswerAsThoseThatAreStoredDo) {
  const std::filesystem::path whole_folder = temporary_.path() / "whole.farlod";
  CutHills(GetParam(), false).write(whole_folder);
  const PackageReader whole(whole_folder), package(folder_);
  EXPECT_EQ(package.z_range_m(), whole.z_range_m());
  EXPECT_EQ(package.manifest().triangles, whole.manifest().triangles);
  std::vector<Receiver> receivers;
  for (std::size_t n = 0; n < 12; ++n)
    receivers.push_back({n, {static_cast<float>(n) * 0.9F, 5.0F, 6.0F + 0.2F * static_cast<float>(n)}, {0.0F, 0.0F, 1.0F}});
  for (const Engine engine : {Engine::exact, Engine::automatic, Engine::rays}) {
    SkySettings settings;
    settings.engine = engine;
    for (const bool bounds : {false, true}) {
      const auto answers_of = [&](const PackageReader& reader) {
        std::array<std::vector<float>, 3> answers;
        answers.fill(std::vector<float>(receivers.size()));
        SkyAnswers to(answers[0]);
        if (bounds) to = SkyAnswers(answers[0], answers[1], answers[2]);
        SkyEvaluator(reader, settings).evaluate({{1, 0}, receivers}, to);
        return answers;
      };
      EXPECT_EQ(answers_of(package), answers_of(whole)) << static_cast<int>(engine) << bounds;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hills, ReliefTilesOf,
                         testing::Values(Hills{"Straight"}, Hills{"Turned", 17.0, 0.5}, Hills{"BelowTheSea", 0.0, 1.0, -7.3F},
                                         Hills{"Broken", 0.0, 1.0, 40.0F, true},
                                         Hills{"BrokenAndTurned", 31.0, 2.0, 40.0F, true}),
                         [](const auto& test) { return test.param.name; });

TEST(SquaresOfPixels, AreLeftOutWhereTheyAreEnough) {
  const CutHills hills({"straight"});
  tiles::PixelSteps steps(hills.raster);
  std::uint64_t offered = 0;
  EXPECT_EQ(steps.leave_out_squares(hills.raster, hills.grid, [&](std::uint64_t count) { return (offered = count, false); }), 0U);
  EXPECT_EQ(offered, hills.tiles.squares_of_readers);
  const auto is_left_out = [](std::uint8_t joined) { return (joined & PixelSquares::left_out) != 0; };
  EXPECT_TRUE(std::ranges::none_of(steps.joined(), is_left_out));
  EXPECT_EQ(steps.leave_out_squares(hills.raster, hills.grid, [](std::uint64_t) { return true; }), offered);
  EXPECT_EQ(static_cast<std::uint64_t>(std::ranges::count_if(steps.joined(), is_left_out)), offered);
}

TEST(SquaresOfPixels, TilesKeepTheirViewsWhenTheyAreMadeAnew) {
  scenes::TemporaryFolder temporary;
  const CutHills hills({"straight"});
  hills.write(temporary.path() / "hills.farlod");
  TileView first;
  std::vector<Corners> expected;
  {
    const PackageReader package(temporary.path() / "hills.farlod");
    first = package.tile({1, 0});
    expected = triangles_as_set(package.tile({1, 0}).mesh);
    EXPECT_EQ(package.tile({1, 0}).mesh.vertices.data(), first.mesh.vertices.data()) << "it is kept";
  }
  EXPECT_EQ(triangles_as_set(first.mesh), expected);
}

}  // namespace
}  // namespace farlod
