// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/tiles_writer.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "package/block_tiles.hpp"
#include "package/existing_package.hpp"
#include "package/layout.hpp"
#include "tests/scenes/edges_as_set.hpp"
#include "tests/scenes/generated_town.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

using namespace package;
using package::Header;
using package::Section;
using package::SectionKind;
using package::TileEdge;
using testing::ElementsAre;
using testing::IsEmpty;

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

/// What a package may take for the geometry of its cells, as a multiple of what the bare mesh takes: 12 bytes for each vertex and
/// 12 for each triangle. The rest is what the mesh belongs to: surfaces, buildings, cells and their horizon. Large cells cut
/// surfaces into fewer triangles, and on hills the ground has more horizon edges than buildings have.
constexpr double most_bytes_of_bare_mesh = 1.5;

struct Bytes {
  std::uint64_t tiles = 0, bare_mesh = 0;
};

/// Adds a tiles file without what its far maps need.
void add(Bytes& sum, std::span<const std::byte> file) {
  Header header{};
  std::memcpy(&header, file.data(), sizeof header);
  sum.tiles += file.size();
  for (std::uint32_t n = 0; n < header.section_count; ++n) {
    Section section{};
    std::memcpy(&section, file.data() + sizeof header + n * sizeof section, sizeof section);
    const std::uint64_t bytes = section.count * section.element_bytes;
    if (section.kind >= SectionKind::far_cells && section.kind <= SectionKind::explicit_edges) sum.tiles -= bytes;
    if (section.kind == SectionKind::vertices || section.kind == SectionKind::triangles) sum.bare_mesh += bytes;
  }
}

struct Town {
  CitySettings settings;
  double cell_edge_m;
};

class TilesFileSize : public testing::TestWithParam<Town> {};

TEST_P(TilesFileSize, IsCloseToThatOfTheBareMesh) {
  const CityModel city = scenes::generated_town(GetParam().settings);
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17.0), GetParam().cell_edge_m, 3);
  Report ignored;
  const TileSet tiles = tiles::cut_into_tiles({city, {}}, grid, Assign::clip, {}, ignored);
  Bytes bytes;
  for (const Block block : grid.blocks()) {
    const BakedBoxes no_far_city(static_cast<std::size_t>(grid.cells_of(block).size()));
    add(bytes, farlod::tiles_file(tiles, no_far_city, grid, block));
  }
  // All triangles are written, and neighbors share their vertices: there are fewer of those than of triangles
  EXPECT_GT(bytes.bare_mesh, tiles.triangle_count() * sizeof(Triangle));
  EXPECT_LT(bytes.bare_mesh, tiles.triangle_count() * (sizeof(Triangle) + sizeof(Point3f)));
  EXPECT_LE(static_cast<double>(bytes.tiles), most_bytes_of_bare_mesh * static_cast<double>(bytes.bare_mesh))
      << static_cast<double>(bytes.tiles) / static_cast<double>(bytes.bare_mesh);
}

Town flat(int lod, double cell_edge_m) {
  Town town{{}, cell_edge_m};
  town.settings.lod = lod;
  return town;
}

Town on_hills_with_overhangs(double cell_edge_m) {
  Town town = flat(2, cell_edge_m);
  town.settings.overhangs = true;
  town.settings.terrain_relief_m = 20.0;
  return town;
}

INSTANTIATE_TEST_SUITE_P(Towns, TilesFileSize,
                         testing::Values(flat(1, 50.0), flat(2, 50.0), on_hills_with_overhangs(50.0), flat(1, 100.0),
                                         flat(2, 100.0), on_hills_with_overhangs(100.0)),
                         [](const auto& instance) {
                           const CitySettings& settings = instance.param.settings;
                           return "Lod" + std::to_string(settings.lod) + (settings.overhangs ? "OnHillsWithOverhangs" : "") +
                                  "InCellsOf" + std::to_string(static_cast<int>(instance.param.cell_edge_m)) + "m";
                         });

/// A block of two cells, a roof in the first, with far maps of either kind, with those of the second cell alone, and without.
class SameTiles : public testing::Test {
 protected:
  SameTiles() {
    grid_.cells = tiles_.cells = {0, 0, 2, 1};
    tiles_.tiles.resize(2);
    tiles_.building_ids = {"house"};
    tiles_.surfaces = {{0, 7, 0, SurfaceKind::roof, {0, 0, 1}, 8.0, false}};
    tiles_.tiles[0].add_polygon({{0, 0, 1}, {4, 0, 1}, {4, 4, 2}}, 0);
    without_ = tiles_file_without_maps(tiles_, grid_, {0, 0});
  }
  [[nodiscard]] std::vector<std::byte> with(const BakedBlock& maps, const std::optional<CellRuns>& mapped = {}) const {
    return farlod::tiles_file(tiles_, maps, grid_, {0, 0}, mapped);
  }
  [[nodiscard]] static BakedHorizon horizon() {
    return {ReceiverPatches(50.0, 1, {0.0F, 2.0F}), {{0, 1, 1}}, {0.0F, 0.0F}, {0.0F, 0.0F}, {0.0F, 0.0F}, {0.0F, 0.0F}};
  }

  Grid grid_;
  TileSet tiles_;
  std::vector<std::byte> without_;
};

TEST_F(SameTiles, FarMapsDoNotCount) {
  EXPECT_TRUE(same_tiles(without_, without_));
  const BakedBox box{{25.0F, 25.0F, 1.5F}, {4, 4, 0.5F}, {}};
  const HorizonEdge edge{{1, 2, 3}, {4, 5, 6}, {}, EdgeRole::grounded};
  const CellRuns second{{{1, 2}}};
  for (const auto& file :
       {with(BakedBoxes{box, box}), with(BakedBoxes{box}, second), with(BakedHorizons{{edge}, {horizon(), horizon()}}),
        with(BakedHorizons{{edge}, {horizon()}}, second)}) {
    EXPECT_NE(file, without_);
    EXPECT_TRUE(same_tiles(file, without_));
  }
}

/// Each byte of the sections of tiles counts.
TEST_F(SameTiles, AByteThatIsChangedIsFound) {
  std::size_t found = 0;
  for (std::size_t n = 0; n < section_count; ++n) {
    Section section{};
    std::memcpy(&section, without_.data() + sizeof(Header) + n * sizeof(Section), sizeof(Section));
    for (std::size_t k = 0; k < section.count * section.element_bytes; ++k) {
      std::vector<std::byte> changed = without_;
      changed.at(section.offset + k) ^= std::byte{0x40};
      // The last five numbers of a cell but its flags are of its far map
      const std::size_t in_cell = k % sizeof(CellRecord);
      const bool is_of_map = section.kind == SectionKind::cells && in_cell >= offsetof(CellRecord, capture_x_m) &&
                             in_cell < offsetof(CellRecord, flags);
      EXPECT_EQ(same_tiles(changed, without_), is_of_map) << n << ' ' << k;
      found += is_of_map ? 0 : 1;
    }
  }
  EXPECT_GT(found, 100U);
}

TEST_F(SameTiles, AFileThatIsCutOffIsAnother) {
  for (std::size_t length = 0; length < without_.size() - end_padding; ++length)
    EXPECT_FALSE(same_tiles(std::span(without_).first(length), without_)) << length;
}

constexpr AdjacentSlopes passing{0, 0};

/// A fan of triangles around its first corner, in the plane.
class FanOfTriangles : public testing::Test {
 protected:
  explicit FanOfTriangles(std::uint32_t count = 2) {
    for (std::uint32_t n = 0; n < count + 2; ++n)
      (void)vertices_.number_of({static_cast<float>(n), static_cast<float>(n % 7), 0});
    for (std::uint32_t n = 0; n < count; ++n) triangles_.push_back({0, n + 1, n + 2});
  }
  [[nodiscard]] HorizonEdge edge(std::uint32_t from, std::uint32_t to, AdjacentSlopes adjacent) const {
    return {vertices_.vertices()[from], vertices_.vertices()[to], adjacent};
  }
  [[nodiscard]] SideEdges written(const std::vector<HorizonEdge>& edges) const {
    return side_edges(edges, triangles_, vertices_);
  }

  SharedVertices vertices_;
  std::vector<Triangle> triangles_;
};

TEST_F(FanOfTriangles, EachSideCanBeAnEdge) {
  const std::array<std::array<std::uint32_t, 2>, 5> sides{{{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}}};
  const std::array<std::uint8_t, 5> passed{0, 1, 2, 4, 5};
  for (std::size_t n = 0; n < sides.size(); ++n) {
    const auto [sides_found, loose] = written({edge(sides[n][0], sides[n][1], {-7, 9})});
    EXPECT_THAT(sides_found, ElementsAre(TileEdge{passed[n], {-7, 9}})) << n;
    EXPECT_THAT(loose, IsEmpty());
  }
}

TEST_F(FanOfTriangles, AnEdgeAgainstItsSideIsTurned) {
  EXPECT_THAT(written({edge(3, 2, {-7, 9})}).sides, ElementsAre(TileEdge{4, {9, -7}}));
}

TEST_F(FanOfTriangles, EdgesFollowTheSides) {
  EXPECT_THAT(written({edge(3, 0, {5, 5}), edge(0, 1, {1, 1}), edge(1, 2, {2, 2})}).sides,
              ElementsAre(TileEdge{0, {1, 1}}, TileEdge{0, {2, 2}}, TileEdge{3, {5, 5}}));
}

TEST_F(FanOfTriangles, EqualEdgesAreDifferentSidesWhileThereAreAny) {
  // Two triangles have it, one the other way round; the third time nobody does
  const auto [sides, loose] = written({edge(0, 2, {1, 2}), edge(0, 2, {3, 4}), edge(0, 2, {5, 6})});
  EXPECT_THAT(sides, ElementsAre(TileEdge{2, {2, 1}}, TileEdge{0, {3, 4}}));
  EXPECT_THAT(loose, ElementsAre(edge(0, 2, {5, 6})));
}

TEST_F(FanOfTriangles, WhatIsNoSideIsLoose) {
  const HorizonEdge between_corners = edge(1, 3, {1, 2});
  const HorizonEdge beside{vertices_.vertices()[0], {0.5F, 0, 0}, {3, 4}};
  const auto [sides, loose] = written({beside, edge(1, 2, {5, 6}), between_corners});
  EXPECT_THAT(sides, ElementsAre(TileEdge{1, {5, 6}}));
  EXPECT_THAT(loose, ElementsAre(beside, between_corners));
}

class LargeFan : public FanOfTriangles {
 protected:
  LargeFan() : FanOfTriangles(500) {}
};

TEST_F(LargeFan, RowsPassAsManySidesAsTheyCan) {
  const auto rims = [&](std::uint32_t triangle) { return edge(triangle + 1, triangle + 2, {1, 2}); };
  // The rim of triangle t is side 3t + 1
  EXPECT_THAT(written({rims(84)}).sides, ElementsAre(TileEdge{253, {1, 2}}));
  EXPECT_THAT(written({edge(0, 86, {1, 2})}).sides, ElementsAre(TileEdge{254, {2, 1}}));
  EXPECT_THAT(written({rims(85)}).sides, ElementsAre(TileEdge{255, passing}, TileEdge{1, {1, 2}}));
  EXPECT_THAT(written({rims(0), edge(87, 0, {3, 4})}).sides,
              ElementsAre(TileEdge{1, {1, 2}}, TileEdge{255, passing}, TileEdge{0, {3, 4}}));
  EXPECT_THAT(written({edge(501, 0, {1, 2})}).sides,
              ElementsAre(TileEdge{255, passing}, TileEdge{255, passing}, TileEdge{255, passing}, TileEdge{255, passing},
                          TileEdge{255, passing}, TileEdge{224, {1, 2}}));
}

class EdgesOfATown : public testing::TestWithParam<Assign> {};

TEST_P(EdgesOfATown, ComeBackAsTheSameSet) {
  CitySettings settings{.terrain_relief_m = 20.0, .lod = 2, .overhangs = true};
  const CityModel city = scenes::generated_town(settings);
  const Grid grid = scenes::grid_covering(city, Angle::degrees(17.0), 50.0, 3);
  Report ignored;
  const TileSet tiles = tiles::cut_into_tiles({city, {}}, grid, GetParam(), {}, ignored);
  std::size_t sides = 0, loose = 0;
  for (const Block block : grid.blocks()) {
    const CellRange cells = grid.cells_of(block);
    const std::vector<std::byte> file =
        farlod::tiles_file(tiles, BakedBoxes(static_cast<std::size_t>(cells.size())), grid, block);
    const BlockTiles written(file, cells, "tiles.bin");
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
      const TileView view = written.tile(cells.cell_at(n));
      std::vector<HorizonEdge> read;
      view.visit_edges([&](const HorizonEdge& e) { read.push_back(e); });
      ASSERT_EQ(scenes::edges_as_set(read), scenes::edges_as_set(tiles.tile(cells.cell_at(n)).horizon_edges)) << n;
      sides += read.size() - view.loose_edges.size();
      loose += view.loose_edges.size();
    }
  }
  EXPECT_GT(sides, 10'000U) << "the scene tests nothing";
  EXPECT_LT(loose, sides / 40) << "naming edges as sides saves nothing";
}

INSTANTIATE_TEST_SUITE_P(All, EdgesOfATown, testing::Values(Assign::clip, Assign::whole),
                         [](const auto& test) { return test.param == Assign::clip ? "Clip" : "Whole"; });

}  // namespace
}  // namespace farlod
