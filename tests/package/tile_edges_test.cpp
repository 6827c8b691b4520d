// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>

#include "package/block_tiles.hpp"
#include "package/tiles_writer.hpp"
#include "tests/package/small_package.hpp"

// The horizon edges of a tiles.bin, and what may be wrong with them.

namespace farlod {
namespace {

using namespace package;
using testing::HasSubstr;

constexpr CellRange two_cells{0, 0, 2, 1};

/// Two cells, each with a square of two triangles, two edges that are sides of them, and two that end beside them.
TilesBytes file_with_edges() {
  const std::array<Point3f, 4> corners{{{0, 0, 1}, {4, 0, 1}, {4, 4, 2}, {0, 4, 2}}};
  const Point3f beside{2, 0, 0.5F};
  TileSet tiles;
  tiles.cells = two_cells;
  tiles.surfaces = {{ground_building, 0, 0, SurfaceKind::ground, {0, 0, 1}, 16.0}};
  Tile tile;
  tile.add_polygon({corners[0], corners[1], corners[2], corners[3]}, ground_surface);
  tile.horizon_edges = {{corners[0], corners[1], {1, 2}},
                        {corners[0], beside, {3, 4}},
                        {beside, corners[1], {5, 6}},
                        {corners[3], corners[0], {7, 8}}};
  tiles.tiles = {tile, tile};
  Grid grid;
  grid.cells = two_cells;
  return TilesBytes(farlod::tiles_file(tiles, BakedBoxes(2), grid, Block{0, 0}));
}

BlockTiles open_edges(TilesBytes& file) { return {file.bytes(), two_cells, "tiles.bin"}; }

std::string edge_damage_after(const std::function<void(TilesBytes&)>& change) {
  TilesBytes file = file_with_edges();
  change(file);
  return damage_met_by([&] { (void)open_edges(file); });
}

CellRecord& cell(TilesBytes& f, std::size_t n) { return f.element<CellRecord>(SectionKind::cells, n); }
TileEdge& side(TilesBytes& f, std::size_t n) { return f.element<TileEdge>(SectionKind::tile_edges, n); }
HorizonEdge& loose(TilesBytes& f, std::size_t n) { return f.element<HorizonEdge>(SectionKind::loose_edges, n); }

TEST(TileEdges, WholeFileOpens) {
  TilesBytes file = file_with_edges();
  ASSERT_EQ(file.section(SectionKind::tile_edges).count, 4U);
  ASSERT_EQ(file.section(SectionKind::loose_edges).count, 4U);
  EXPECT_EQ(edge_damage_after([](TilesBytes&) {}), "no damage");
}

TEST(TileEdges, EntriesThatOnlySkipStoreNoEdge) {
  TilesBytes file = file_with_edges();
  // The two entries become one that skips 255 sides and one that skips none, of a triangle that is repeated often enough
  const Triangle t{0, 1, 2};
  TileView view = open_edges(file).tile({0, 0});
  const std::vector<Triangle> many(100, t);
  const std::vector<TileEdge> rows{{TileEdge::skip_only, {}}, {2, {1, 2}}, {0, {3, 4}}};
  view.mesh.triangles = many;
  view.edge_sides = {rows};
  view.loose_edges = {};
  std::vector<HorizonEdge> read;
  view.visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
  const auto corners = view.mesh.vertices;
  // 257 is the third side of triangle 85, 258 the first of the next
  EXPECT_EQ(read, (std::vector<HorizonEdge>{{corners[2], corners[0], {1, 2}}, {corners[0], corners[1], {3, 4}}}));
}

std::vector<HorizonEdge> read_from(TilesBytes& file, Cell from) {
  const BlockTiles tiles = open_edges(file);
  std::vector<HorizonEdge> read;
  tiles.tile(from).visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
  return read;
}

TEST(TileEdges, EachRoleCountsFromTheFirstSide) {
  TilesBytes file = file_with_edges();
  std::vector<HorizonEdge> expected = read_from(file, {1, 0});
  ASSERT_EQ(expected.size(), 4U);
  // The two rows of the cell become the only ones of other roles: the second one skips five sides by itself
  const std::size_t first = file.section(SectionKind::tile_edges).count - 2;
  cell(file, 1).edge_counts = {0, 1, 1};
  side(file, first + 1).sides_skipped = 5;
  expected[0].role = EdgeRole::overhang;
  expected[1].role = EdgeRole::underside;
  EXPECT_EQ(read_from(file, {1, 0}), expected);
}

TEST(TileEdges, RolesAreKept) {
  for (const EdgeRole role : {EdgeRole::grounded, EdgeRole::overhang, EdgeRole::underside}) {
    TilesBytes file = file_with_edges();
    loose(file, 3).role = role;
    EXPECT_EQ(read_from(file, {1, 0}).back().role, role);
  }
}

TEST(TileEdges, ARoleThatDoesNotExist) {
  for (const std::uint16_t bad : {std::uint16_t{edge_role_count}, std::uint16_t{256}, std::uint16_t{0xFFFF}})
    EXPECT_THAT(edge_damage_after([=](TilesBytes& f) { loose(f, 3).role = EdgeRole{bad}; }),
                HasSubstr("role that does not exist"));
}

TEST(TileEdges, SideOfAMissingTriangle) {
  // The last one of the cell's two rows is side 5, the last of its two triangles
  EXPECT_EQ(edge_damage_after([](TilesBytes& f) { --side(f, 1).sides_skipped; }), "no damage");
  for (const std::size_t n : {0U, 1U, 3U})
    for (const int more : {1, 100}) {
      const auto skip_more = [=](TilesBytes& f) {
        side(f, n).sides_skipped = static_cast<std::uint8_t>(side(f, n).sides_skipped + more);
      };
      EXPECT_THAT(edge_damage_after(skip_more), HasSubstr("side of a triangle that does not exist")) << n;
    }
  EXPECT_THAT(edge_damage_after([](TilesBytes& f) { side(f, 1).sides_skipped = TileEdge::skip_only; }),
              HasSubstr("side of a triangle that does not exist"));
}

TEST(TileEdges, SideOfAMissingTriangleInAnyRole) {
  for (std::size_t role = 1; role < edge_role_count; ++role) {
    // The last row of the cell is alone in its role, and skips no more than the sides of two triangles
    const auto change = [role](TilesBytes& f, std::uint8_t skipped) {
      cell(f, 1).edge_counts[0] = cell(f, 1).edge_counts[role] = 1;
      side(f, 3).sides_skipped = skipped;
    };
    EXPECT_EQ(edge_damage_after([&](TilesBytes& f) { change(f, 5); }), "no damage");
    EXPECT_THAT(edge_damage_after([&](TilesBytes& f) { change(f, 6); }), HasSubstr("side of a triangle that does not exist"));
  }
}

TEST(TileEdges, RisesBeyondARightAngle) {
  constexpr std::int8_t beyond = -128;
  for (auto direction : {&AdjacentSlopes::left, &AdjacentSlopes::right}) {
    EXPECT_THAT(edge_damage_after([=](TilesBytes& f) { side(f, 1).adjacent.*direction = beyond; }),
                HasSubstr("beyond a right angle"));
    EXPECT_THAT(edge_damage_after([=](TilesBytes& f) { loose(f, 1).adjacent.*direction = beyond; }),
                HasSubstr("beyond a right angle"));
    for (const std::int8_t right : {std::int8_t{-127}, std::int8_t{127}})
      EXPECT_EQ(edge_damage_after([=](TilesBytes& f) {
                  side(f, 1).adjacent.*direction = right;
                  loose(f, 1).adjacent.*direction = right;
                }),
                "no damage");
  }
}

TEST(TileEdges, NowhereOnEarth) {
  for (const float bad : {2e7F, -1e20F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (auto end : {&HorizonEdge::a, &HorizonEdge::b})
      for (auto part : {&Point3f::x, &Point3f::y, &Point3f::z})
        EXPECT_THAT(edge_damage_after([=](TilesBytes& f) { loose(f, 3).*end.*part = bad; }),
                    HasSubstr("an edge lies nowhere on Earth"));
}

TEST(TileEdges, CellsOwnMoreThanTheFileHolds) {
  for (const std::uint32_t more : {1U, 1000U, 0xFFFF0000U}) {
    for (std::size_t role = 0; role < edge_role_count; ++role)
      EXPECT_THAT(edge_damage_after([=](TilesBytes& f) { cell(f, 1).edge_counts[role] += more; }),
                  HasSubstr("cell's edges reach beyond"));
    EXPECT_THAT(edge_damage_after([=](TilesBytes& f) { cell(f, 1).loose_edge_count += more; }),
                HasSubstr("cell's loose edges reach beyond"));
  }
  EXPECT_THAT(edge_damage_after([](TilesBytes& f) { --f.section(SectionKind::tile_edges).count; }),
              HasSubstr("edges reach beyond"));
  EXPECT_THAT(edge_damage_after([](TilesBytes& f) { --f.section(SectionKind::loose_edges).count; }),
              HasSubstr("loose edges reach beyond"));
}

TEST(TileEdges, CellsOwnLessThanTheFileHolds) {
  EXPECT_THAT(edge_damage_after([](TilesBytes& f) { --cell(f, 1).edge_counts[0]; }), HasSubstr("more than its cells own"));
  EXPECT_THAT(edge_damage_after([](TilesBytes& f) { --cell(f, 1).loose_edge_count; }), HasSubstr("more than its cells own"));
}

}  // namespace
}  // namespace farlod
