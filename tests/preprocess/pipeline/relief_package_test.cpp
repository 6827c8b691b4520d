// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "package/pixel_heights.hpp"
#include "tests/preprocess/pipeline/packing.hpp"

namespace farlod::pipeline::test {
namespace {

namespace fs = std::filesystem;

/// What pixels of 1 m show: hills with noise; the same with blocks of 6 m on it, as lasers survey a town; the same blocks on
/// level ground, as footprints burn them; level ground.
enum class Shown { hills, survey, blocks, level };

/// An ESRI ASCII grid of 60 × 50 pixels.
std::string grid_of(Shown shown) {
  std::ostringstream text;
  text << "ncols 60\nnrows 50\nxllcorner 500000\nyllcorner 5500000\ncellsize 1\n";
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 60; ++column) {
      double height_m = 20.0;
      if (shown == Shown::hills || shown == Shown::survey)
        height_m += 3.0 * std::sin(0.2 * column) * std::cos(0.17 * row) + noise(random);
      const bool has_blocks = shown == Shown::survey || shown == Shown::blocks;
      if (has_blocks && column % 10 < 3 && row % 10 < 4) height_m += 6.0;
      text << height_m << (column < 59 ? ' ' : '\n');
    }
  return text.str();
}

/// Cells of 12 m in blocks of 3 × 3.
struct ReliefPacking : Packing {
  explicit ReliefPacking(Shown shown = Shown::hills) {
    settings.grid.block_edge = 3;
    settings.grid.cell_edge_m = 12.0;
    settings.far_map = scenes::small_maps(FarMapKind::horizon);
    settings.georeference.crs = "EPSG:32632";
    settings.inputs = {write("relief.asc", grid_of(shown))};
  }
  [[nodiscard]] package::Manifest manifest() const { return read_manifest(settings.output); }
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(settings.output))
      if (entry.is_regular_file()) files[fs::relative(entry.path(), settings.output).string()] = scenes::text_of(entry.path());
    return files;
  }
};

/// The middle of an edge in the plan, in centimetres of the grid frame.
std::pair<long, long> middle_of(const HorizonEdge& e, Point2d corner_m) {
  const auto cm = [](double a, double b, double from) { return std::lround(100.0 * (0.5 * (a + b) + from)); };
  return {cm(e.a.x, e.b.x, corner_m.x), cm(e.a.y, e.b.y, corner_m.y)};
}

std::size_t far_edges_that_no_file_of_tiles_has(const PackageReader& reader) {
  const Grid& grid = reader.grid();
  std::set<std::pair<long, long>> stored, far;
  for (std::size_t n = 0; n < static_cast<std::size_t>(grid.cells.size()); ++n) {
    const Cell cell = grid.cells.cell_at(n);
    const Point2d corner_m = grid.corner_of(cell);
    reader.block_tiles(cell).tile(cell).visit_edges([&](const HorizonEdge& e) { stored.insert(middle_of(e, corner_m)); });
    if (!reader.has_far_map(cell)) continue;
    const ExplicitOccluders named = reader.far_horizon(cell).occluders;
    for (const package::ExplicitOccluder& o : named.explicit_edges)
      far.insert(middle_of(named.edges[o.row], corner_m + named.cell_from_block_m));
  }
  std::erase_if(far, [&](const auto& middle) { return stored.contains(middle); });
  return far.size();
}

TEST(ReliefPackage, LeavesMostSquaresToReaders) {
  for (const Shown shown : {Shown::hills, Shown::survey}) {
    ReliefPacking p(shown);
    p.run();
    const package::Manifest m = p.manifest();
    ASSERT_TRUE(m.pixels && m.pixels->squares);
    EXPECT_EQ(m.version, package::relief_format_version);
    EXPECT_GT(*m.pixels->squares, 59U * 49U / 2U);
    EXPECT_EQ(m.pixels->walls.value_or(0) > 0, shown == Shown::survey);
    EXPECT_TRUE(package::has_rough_surface(m));
    EXPECT_TRUE(p.result.package.has_rough_surface) << "and the run tells it";
    EXPECT_EQ(m.cells_with_far_map(), 0U);
    EXPECT_GT(m.triangles, 2U * 59U * 49U);
    EXPECT_EQ(p.result.estimate.far_maps, 0U) << "it is known beforehand";
  }
}

TEST(ReliefPackage, LeavesNoneOfBlocksOnLevelGround) {
  for (const Shown shown : {Shown::blocks, Shown::level}) {
    ReliefPacking p(shown);
    p.run();
    const package::Manifest m = p.manifest();
    EXPECT_FALSE(m.pixels->squares.has_value());
    EXPECT_EQ(m.version, package::format_version);
    EXPECT_FALSE(package::has_rough_surface(m));
    EXPECT_EQ(p.result.estimate.far_maps, m.cells_with_far_map());
    EXPECT_EQ(m.pixels->walls.value_or(0) > 0, shown == Shown::blocks);
    const PackageReader reader(p.settings.output);
    ASSERT_NE(reader.pixel_heights(), nullptr);
    EXPECT_FALSE(reader.pixel_heights()->in_grid().has_value());
  }
}

TEST(ReliefPackage, LeavesNoneWhereAllCellsGetFarMaps) {
  ReliefPacking p;
  p.settings.far_map = scenes::small_maps(FarMapKind::box);
  p.run();
  EXPECT_FALSE(p.manifest().pixels->squares.has_value());
  EXPECT_TRUE(p.manifest().is_fully_mapped());
}

TEST(ReliefPackage, GetsTheFarMapsOfAnAreaFromTheWholeSurface) {
  ReliefPacking p;
  p.run();
  const package::Manifest without = p.manifest();
  p.settings.area = Box2d{{500013.0, 5500013.0}, {500023.0, 5500023.0}};
  p.run();
  const package::Manifest m = p.manifest();
  EXPECT_EQ(m.pixels->squares, without.pixels->squares);
  EXPECT_EQ(m.pixels->heights, without.pixels->heights);
  EXPECT_EQ(m.triangles, without.triangles);
  EXPECT_GT(m.cells_with_far_map(), 0U);
  EXPECT_LT(m.cells_with_far_map(), 5U);
  EXPECT_GT(far_edges_that_no_file_of_tiles_has(PackageReader(p.settings.output)), 50U);
}

TEST(ReliefPackage, HasTheSameBytesInShards) {
  ReliefPacking whole, p;
  whole.run();
  p.settings.part = PackPart::shard;
  for (const std::size_t index : {1U, 0U}) {
    ReliefPacking shard;
    shard.settings = p.settings;
    shard.settings.shard = {index, 2};
    shard.run();
  }
  p.settings.part = PackPart::merge;
  p.run();
  EXPECT_EQ(p.files(), whole.files());
}

}  // namespace
}  // namespace farlod::pipeline::test
