// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/tiles_writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "package/block_tiles.hpp"
#include "package/shared_vertices.hpp"

namespace farlod {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

TEST(SharedVertices, AreOneOnlyWhereTheyAreEqual) {
  SharedVertices shared;
  const Point3f p{12.5F, 0.1F, 3.0F};
  EXPECT_EQ(shared.number_of(p), 0U);
  for (auto coordinate : {&Point3f::x, &Point3f::y, &Point3f::z})
    for (const float towards : {-infinite, infinite}) {
      Point3f neighbor = p;
      neighbor.*coordinate = std::nextafter(neighbor.*coordinate, towards);
      const auto next = static_cast<std::uint32_t>(shared.vertices().size());
      EXPECT_EQ(shared.number_of(neighbor), next);
      EXPECT_EQ(shared.vertices().back(), neighbor);
    }
  EXPECT_EQ(shared.number_of(p), 0U);
  EXPECT_EQ(shared.vertices().size(), 7U);
}

/// Two triangles that share an edge, of two surfaces, in the one cell of a grid.
class TilesWriter : public testing::Test {
 protected:
  TilesWriter() {
    grid_.cells = tiles_.cells = {0, 0, 1, 1};
    tiles_.tiles.resize(1);
    tiles_.building_ids = {"house"};
    tiles_.surfaces = {{ground_building, 0, 0, SurfaceKind::ground, {0, 0, 1}, 8.0},
                       {0, 7, 0, SurfaceKind::roof, {0, 0, 1}, 8.0, false}};
    tile().add_polygon({corners_[0], corners_[1], corners_[2]}, 1);
    tile().add_polygon({corners_[0], corners_[2], corners_[3]}, ground_surface);
  }
  Tile& tile() { return tiles_.tiles[0]; }

  /// What comes back from the file.
  TileView written() {
    bytes_ = farlod::tiles_file(tiles_, BakedBoxes(1), grid_, Block{0, 0});
    block_.emplace(bytes_, grid_.cells, "tiles.bin");
    return block_->tile({0, 0});
  }

  const std::array<Point3f, 4> corners_{{{0, 0, 1}, {4, 0, 1}, {4, 4, 2}, {0, 4, 2}}};
  Grid grid_;
  TileSet tiles_;
  std::vector<std::byte> bytes_;
  std::optional<BlockTiles> block_;
};

TEST_F(TilesWriter, WritesTheVerticesOfNeighboringTrianglesOnce) {
  const TileView view = written();
  EXPECT_TRUE(std::equal(view.mesh.vertices.begin(), view.mesh.vertices.end(), corners_.begin(), corners_.end()));
  ASSERT_EQ(view.mesh.triangles.size(), 2U);
  EXPECT_EQ(view.mesh.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(view.mesh.triangles[1], (Triangle{0, 2, 3}));
}

TEST_F(TilesWriter, FindsTheSurfaceOfEachTriangle) {
  tile().add_polygon({corners_[0], corners_[1], corners_[2], corners_[3]}, 1);  // again, after another
  const TileView view = written();
  const std::vector<SurfaceKind> kinds{SurfaceKind::roof, SurfaceKind::ground, SurfaceKind::roof, SurfaceKind::roof};
  ASSERT_EQ(view.mesh.triangles.size(), kinds.size());
  for (std::uint32_t t = 0; t < kinds.size(); ++t) EXPECT_EQ(view.surface_of(t).kind(), kinds[t]) << t;
  EXPECT_EQ(view.surface_runs.size(), 3U);
  EXPECT_FALSE(view.surface_of(0).is_grounded());
  EXPECT_TRUE(view.surface_of(1).is_grounded());
}

TEST_F(TilesWriter, NamesEdgesAsSidesOfTriangles) {
  tile().horizon_edges = {{corners_[3], corners_[0], {1, 2}}, {corners_[2], corners_[1], {3, 4}}};
  const TileView view = written();
  EXPECT_TRUE(std::ranges::equal(view.edge_sides[0], std::vector<package::TileEdge>{{1, {4, 3}}, {3, {1, 2}}}));
  EXPECT_TRUE(view.loose_edges.empty());
}

TEST_F(TilesWriter, NamesTheEdgesOfEachRoleByThemselves) {
  // An edge may be a horizon and a lower border at once
  const HorizonEdge upper{corners_[3], corners_[0], {1, 2}, EdgeRole::overhang};
  const HorizonEdge lower{corners_[3], corners_[0], {5, AdjacentSlopes::straight_up}, EdgeRole::underside};
  const HorizonEdge grounded{corners_[0], corners_[1], {3, 4}};
  tile().horizon_edges = {lower, upper, grounded};
  const TileView view = written();
  EXPECT_TRUE(std::ranges::equal(view.edge_sides[0], std::vector<package::TileEdge>{{0, {3, 4}}}));
  EXPECT_TRUE(std::ranges::equal(view.edge_sides[1], std::vector<package::TileEdge>{{5, {1, 2}}}));
  EXPECT_TRUE(std::ranges::equal(view.edge_sides[2], std::vector<package::TileEdge>{{5, {5, AdjacentSlopes::straight_up}}}));
  EXPECT_TRUE(view.loose_edges.empty());
  std::vector<HorizonEdge> read;
  view.visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
  EXPECT_EQ(read, (std::vector<HorizonEdge>{grounded, upper, lower}));
}

TEST_F(TilesWriter, WritesAnEdgeThatEndsBesideTheMeshAsItIs) {
  const Point3f beside{2, 0, 0.5F};
  tile().horizon_edges = {{corners_[0], beside, {5, -6}}, {beside, corners_[1], {}, EdgeRole::underside}};
  const TileView view = written();
  EXPECT_TRUE(std::ranges::equal(view.loose_edges, tile().horizon_edges));
  for (const auto& sides : view.edge_sides) EXPECT_TRUE(sides.empty());
  EXPECT_EQ(view.mesh.vertices.size(), corners_.size());
  EXPECT_EQ(view.cell->z_low_m, 1.0F) << "a cell's heights are those of its vertices";
}

TEST_F(TilesWriter, KeepsTheEdgesOfEachCellToItself) {
  grid_.cells = tiles_.cells = {0, 0, 2, 1};
  tiles_.tiles.resize(2);
  tiles_.tiles[1] = tile();
  const Point3f beside{2, 0, 0.5F};
  tile().horizon_edges = {{corners_[2], corners_[3]}, {corners_[0], beside}};
  tiles_.tiles[1].horizon_edges = {{corners_[0], corners_[1]}, {beside, corners_[1]}};
  bytes_ = farlod::tiles_file(tiles_, BakedBoxes(2), grid_, Block{0, 0});
  const BlockTiles block(bytes_, grid_.cells, "tiles.bin");
  for (const int i : {0, 1}) {
    std::vector<HorizonEdge> read;
    block.tile({i, 0}).visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
    EXPECT_EQ(read, tiles_.tiles[static_cast<std::size_t>(i)].horizon_edges) << i;
  }
}

TEST_F(TilesWriter, WritesATileWithoutAnything) {
  tile() = {};
  const TileView view = written();
  EXPECT_TRUE(view.mesh.vertices.empty() && view.mesh.triangles.empty() && view.surface_runs.empty());
  for (const auto& sides : view.edge_sides) EXPECT_TRUE(sides.empty());
  EXPECT_TRUE(view.loose_edges.empty());
}

}  // namespace
}  // namespace farlod
