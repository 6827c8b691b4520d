// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "view/view_frame.hpp"

namespace farlod {
namespace {

using nlohmann::json;

/// A grid of so many cells of 100 m, turned by 20°.
ViewFrame frame_of(std::int32_t columns, std::int32_t rows) {
  return {.origin_projected = {500000.0, 5000000.0, 100.0},
          .grid_axes = GridAxes::turned_by(Angle::degrees(20.0)),
          .convergence = {},
          .cell_edge_m = 100.0,
          .cells = {-2, -1, columns - 2, rows - 1},
          .corner_local = {-200.0, -100.0},
          .low_local = 0.0,
          .high_local = 60.0};
}

std::vector<TileAddress> tiles_of_level(const TileTree& tree, std::uint32_t level) {
  std::vector<TileAddress> tiles;
  for (std::uint32_t y = 0; y < 1U << level; ++y)
    for (std::uint32_t x = 0; x < 1U << level; ++x)
      if (tree.contains({level, x, y})) tiles.push_back({level, x, y});
  return tiles;
}

TEST(TileTree, TheLargestTilesGrowWithTheCity) {
  const auto first = [](std::int32_t edge) { return TileTree(frame_of(edge, edge)).first_level_with_content(); };
  EXPECT_EQ(first(8), 0U);
  EXPECT_EQ(first(16), 1U);
  EXPECT_EQ(first(32), 2U) << "of 8 × 8 cells";
  EXPECT_EQ(first(33), 2U) << "of 16 × 16 cells";
  EXPECT_EQ(first(100), 3U);
}

TEST(TileTree, TheMiddleComesFirst) {
  // 40 × 40 cells of a square of 64 × 64: 3 × 3 tiles of 16 × 16 cells, of which the second one has the middle
  const TileTree tree(frame_of(40, 40));
  EXPECT_EQ(tree.largest_tiles_from_the_middle(1), (std::vector<TileAddress>{{2, 1, 1}}));
  const std::vector<TileAddress> all = tree.largest_tiles_from_the_middle(100);
  EXPECT_EQ(all.size(), 9U);
  EXPECT_EQ(all.back(), (TileAddress{2, 2, 2})) << "the farthest one";
}

TEST(TileTree, FrameIsItsOwnInverse) {
  const ViewFrame frame = frame_of(3, 3);
  const Point2d p{12.0, 345.0}, there = frame.local_from_grid(p), back = frame.grid_from_local(there);
  EXPECT_NEAR(back.x, p.x, 1e-9);
  EXPECT_NEAR(back.y, p.y, 1e-9);
  // 100 m along the grid's y axis lead 20° east of north
  const Point2d along = frame.local_from_grid({0.0, 100.0}) - frame.local_from_grid({0.0, 0.0});
  EXPECT_NEAR(along.x, 34.202014, 1e-6);
  EXPECT_NEAR(along.y, 93.969262, 1e-6);
}

TEST(TileTree, EachLevelCoversEachCellOnce) {
  const TileTree tree(frame_of(5, 3));
  EXPECT_EQ(tree.level_of_cells(), 3U);
  for (std::uint32_t level = 0; level <= tree.level_of_cells(); ++level) {
    std::multiset<CellPlace> cells;
    for (const TileAddress& tile : tiles_of_level(tree, level)) {
      const CellRectangle of_tile = tree.cells_of(tile);
      for (std::int32_t j = of_tile.j_begin; j < of_tile.j_end; ++j)
        for (std::int32_t i = of_tile.i_begin; i < of_tile.i_end; ++i) cells.insert({i, j});
    }
    EXPECT_EQ(cells.size(), 15U) << level;
    EXPECT_EQ(std::set<CellPlace>(cells.begin(), cells.end()).size(), 15U) << level;
  }
}

TEST(TileTree, BelowCellsTilesArePartsOfOne) {
  const TileTree tree(frame_of(5, 3));
  EXPECT_EQ(tiles_of_level(tree, 5).size(), 15U * 16U);
  EXPECT_EQ(tree.cells_of({5, 4 * 2 + 3, 4 * 1}), (CellRectangle{0, 0, 1, 1}));
  EXPECT_EQ(tree.square_of({5, 11, 4}).edge_m, 25.0);
  EXPECT_EQ(tree.square_of({5, 11, 4}).low, (Point2d{275.0, 100.0}));
  EXPECT_FALSE(tree.contains({6, 0, 0}));
  EXPECT_FALSE(tree.contains({3, 5, 0})) << "no cell is there";
  EXPECT_FALSE(tree.contains({1, 2, 0})) << "beyond the root";
}

TEST(TileTree, ErrorsHalve) {
  const TileTree tree(frame_of(5, 3));
  for (std::uint32_t level = 1; level < tree.levels(); ++level)
    EXPECT_EQ(2.0 * tree.geometric_error_m(level), tree.geometric_error_m(level - 1));
}

TEST(TileTree, TilesOfManyCellsHaveNoContent) {
  const TileTree tree(frame_of(64, 64));
  EXPECT_TRUE(tree.contains({1, 0, 0}));
  EXPECT_FALSE(tree.has_content({1, 0, 0}));
  EXPECT_TRUE(tree.has_content({2, 0, 0}));
  EXPECT_EQ(tree.cells_of({3, 1, 0}), (CellRectangle{6, -1, 14, 7}));
}

/// A subtree, as the specification of 3D Tiles 1.1 has it.
struct Subtree {
  json head;
  std::string bytes;

  explicit Subtree(const std::string& file) {
    std::uint64_t lengths[2];
    std::memcpy(lengths, file.data() + 8, sizeof(lengths));
    EXPECT_EQ(file.substr(0, 8), std::string("subt\1\0\0\0", 8));
    EXPECT_EQ(lengths[0] % 8, 0U);
    EXPECT_EQ(file.size(), 24 + lengths[0] + lengths[1]);
    head = json::parse(file.substr(24, lengths[0]));
    bytes = file.substr(24 + lengths[0]);
  }
  [[nodiscard]] bool bit(const json& availability, std::size_t n) const {
    if (availability.contains("constant")) return availability.at("constant") == 1;
    const json& view = head.at("bufferViews").at(availability.at("bitstream").get<std::size_t>());
    const auto byte = static_cast<unsigned char>(bytes.at(view.at("byteOffset").get<std::size_t>() + n / 8));
    return (byte >> (n % 8) & 1U) != 0;
  }
};

TEST(TileTree, SubtreesSayWhatThereIs) {
  const TileTree tree(frame_of(5, 3));
  const Subtree subtree(subtree_file(tree, {}));
  // Level 1 begins at bit 1; of its four tiles the third and fourth, in Morton order, lie beyond the three rows of cells
  const json& tiles = subtree.head.at("tileAvailability");
  EXPECT_TRUE(subtree.bit(tiles, 0));
  EXPECT_TRUE(subtree.bit(tiles, 1));
  EXPECT_TRUE(subtree.bit(tiles, 2));
  EXPECT_FALSE(subtree.bit(tiles, 3));
  EXPECT_FALSE(subtree.bit(tiles, 4));
  // Of the 64 cells of level 3 those are there that the grid has: (x, y) = (4, 2) has the Morton number 0b011000
  EXPECT_TRUE(subtree.bit(tiles, 1 + 4 + 16 + 0b011000));
  EXPECT_FALSE(subtree.bit(tiles, 1 + 4 + 16 + 0b011001)) << "(5, 2) is no cell";
  std::size_t count = 0;
  for (std::uint32_t level = 0; level < tree.levels(); ++level) count += tiles_of_level(tree, level).size();
  EXPECT_EQ(tiles.at("availableCount"), count);
  EXPECT_EQ(subtree.head.at("contentAvailability").at(0).at("availableCount"), count);
}

TEST(TileTree, SubtreesGoOnBelow) {
  const TileTree tree(frame_of(64, 64));
  const Subtree root(subtree_file(tree, {})), below(subtree_file(tree, {6, 63, 63}));
  EXPECT_TRUE(root.bit(root.head.at("childSubtreeAvailability"), 4095));
  EXPECT_EQ(below.head.at("tileAvailability").at("availableCount"), 1U + 4U + 16U);
  EXPECT_EQ(below.head.at("childSubtreeAvailability"), (json{{"constant", 0}}));
}

TEST(TileTree, TilesWithoutContentAreOffByTheirSize) {
  const TileTree tree(frame_of(64, 40));
  const Subtree root(subtree_file(tree, {})), below(subtree_file(tree, {6, 0, 0}));
  const json& table = root.head.at("propertyTables").at(root.head.at("tileMetadata").get<std::size_t>());
  EXPECT_EQ(table.at("count"), root.head.at("tileAvailability").at("availableCount"));
  const json& view = root.head.at("bufferViews").at(table.at("properties").at("geometricError").at("values").get<std::size_t>());
  std::vector<double> errors(view.at("byteLength").get<std::size_t>() / sizeof(double));
  ASSERT_EQ(errors.size(), table.at("count"));
  ASSERT_EQ(view.at("byteOffset").get<std::size_t>() % sizeof(double), 0U);
  std::memcpy(errors.data(), root.bytes.data() + view.at("byteOffset").get<std::size_t>(), errors.size() * sizeof(double));
  // Levels 0 and 1 have no content; 64 × 40 cells are 1, 2 × 2, 4 × 3 and 8 × 5 tiles
  EXPECT_EQ(errors.front(), 6400.0);
  EXPECT_EQ(errors.at(1 + 3), 3200.0);
  EXPECT_EQ(errors.at(1 + 4 + 11), 48.0);
  EXPECT_EQ(errors.at(1 + 4 + 12), 24.0);
  EXPECT_EQ(errors.at(1 + 4 + 12 + 40), 12.0);
  EXPECT_EQ(errors.back(), tree.geometric_error_m(5));
  EXPECT_FALSE(below.head.contains("propertyTables")) << "all of its tiles have content";
  const json tileset = json::parse(tileset_json(frame_of(64, 40), tree, {}));
  EXPECT_GE(tileset.at("geometricError").get<double>(), errors.front());
  EXPECT_EQ(tileset.at("root").at("geometricError"), tree.geometric_error_m(0)) << "those of all levels follow from it";
  const json& property = tileset.at("schema").at("classes").at(table.at("class")).at("properties").at("geometricError");
  EXPECT_EQ(property.at("semantic"), "TILE_GEOMETRIC_ERROR");
}

TEST(TileTree, TheTilesetHasTheBoxOfTheGrid) {
  const ViewFrame frame = frame_of(5, 3);
  const json root =
      json::parse(tileset_json(frame, TileTree(frame), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1})).at("root");
  const auto box = root.at("boundingVolume").at("box").get<std::vector<double>>();
  EXPECT_NEAR(box[3], 400.0 * cos(Angle::degrees(20.0)), 1e-9);
  EXPECT_NEAR(box[4], -400.0 * sin(Angle::degrees(20.0)), 1e-9);
  EXPECT_NEAR(box[2], 30.0, 1e-9);
  EXPECT_EQ(root.at("transform").at(12), 7.0);
  EXPECT_EQ(root.at("implicitTiling").at("availableLevels"), 6);
}

/// What sums of squares of coordinates of some metres leave of a double.
constexpr double rounding = 1e-12;

Point3d axis_of(const EcefFromLocal& m, std::size_t n) { return {m[4 * n], m[4 * n + 1], m[4 * n + 2]}; }

void expect_similar(const EcefFromLocal& m, double scale) {
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_NEAR(norm(axis_of(m, n)), scale, rounding) << n;
    EXPECT_NEAR(dot(axis_of(m, n), axis_of(m, (n + 1) % 3)), 0.0, rounding) << n;
  }
  EXPECT_GT(dot(cross(axis_of(m, 0), axis_of(m, 1)), axis_of(m, 2)), 0.0) << "a mirror image";
}

TEST(PlacedOnGlobe, AMapIsTurnedAndEnlargedAlike) {
  const EcefFromLocal m = similar_frame({0.0, 1.0002, 0.0}, {-1.0002, 0.0, 0.0}, {7.0, 8.0, 9.0});
  expect_similar(m, 1.0002);
  EXPECT_NEAR(m[1], 1.0002, rounding);
  EXPECT_NEAR(m[4], -1.0002, rounding);
  EXPECT_EQ((Point3d{m[12], m[13], m[14]}), (Point3d{7.0, 8.0, 9.0}));
}

TEST(PlacedOnGlobe, AMapThatIsSkewIsMetHalfWay) {
  const Angle skew = Angle::degrees(1.0);
  const EcefFromLocal m = similar_frame({4.0, 0.0, 0.0}, {sin(skew), cos(skew), 0.0}, {});
  expect_similar(m, 2.0);
  EXPECT_NEAR(std::atan2(m[1], m[0]), -Angle::degrees(0.5).radians(), rounding);
}

#ifdef FARLOD_WITH_GDAL
TEST(PlacedOnGlobe, UtmIsWhereItShouldBe) {
  PackageDescription description;
  description.crs_wkt = "EPSG:32631";
  ViewFrame frame;
  // On the equator and the central meridian of 3° east, where the scale is 0.9996: a metre of the map is 1/0.9996 m long
  frame.origin_projected = {500000.0, 0.0, 20.0};
  const EcefFromLocal m = placed_on_globe(description, frame);
  // To a micrometre a metre, since the map is a chord of 200 m of a curved Earth
  const double scale = 1.0 / 0.9996;
  EXPECT_NEAR(norm(axis_of(m, 0)), scale, 1e-5);
  EXPECT_NEAR(norm(axis_of(m, 2)), norm(axis_of(m, 0)), rounding);
  const Angle east = Angle::degrees(3.0);
  EXPECT_NEAR(m[12], (6378137.0 + 20.0) * cos(east), 1e-3);
  EXPECT_NEAR(m[13], (6378137.0 + 20.0) * sin(east), 1e-3);
  EXPECT_NEAR(m[14], 0.0, 1e-3);
  EXPECT_NEAR(m[8], scale * cos(east), 1e-5) << "up";
  EXPECT_NEAR(m[6], scale, 1e-5) << "north";
}
#endif

}  // namespace
}  // namespace farlod
