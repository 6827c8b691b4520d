// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "results/value_text.hpp"

namespace farlod {
namespace {

/// The error of tiles that are one cell: less than what is seen of a wall. Those of larger tiles are its multiples.
constexpr double error_of_cells_m = 3.0;

using Json = nlohmann::ordered_json;

/// A bit for each tile, from the lowest bit of the first byte on.
class TileBits {
 public:
  void add(bool is_set) {
    if (size_ % 8 == 0) bytes_.push_back('\0');
    if (is_set) bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) | (1U << (size_ % 8)));
    ++size_;
    count_ += is_set ? 1 : 0;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::string bytes_;
  std::size_t size_ = 0, count_ = 0;
};

/// The tile at a place of the Morton order of its level.
TileAddress tile_of_morton(const TileAddress& root, std::uint32_t depth, std::uint32_t place) {
  TileAddress tile{root.level + depth, root.x << depth, root.y << depth};
  for (std::uint32_t bit = 0; bit < depth; ++bit) {
    tile.x |= (place >> (2 * bit) & 1U) << bit;
    tile.y |= (place >> (2 * bit + 1) & 1U) << bit;
  }
  return tile;
}

struct SubtreeBits {
  TileBits tiles, contents, children;
};

SubtreeBits bits_of(const TileTree& tree, const TileAddress& root) {
  SubtreeBits bits;
  for (std::uint32_t depth = 0; depth < levels_of_subtree; ++depth)
    for (std::uint32_t place = 0; place < 1U << (2 * depth); ++place) {
      const TileAddress tile = tile_of_morton(root, depth, place);
      bits.tiles.add(tree.contains(tile));
      bits.contents.add(tree.has_content(tile));
    }
  for (std::uint32_t place = 0; place < 1U << (2 * levels_of_subtree); ++place)
    bits.children.add(tree.contains(tile_of_morton(root, levels_of_subtree, place)));
  return bits;
}

/// Views of the one buffer, each at a multiple of eight bytes.
class SubtreeBuffer {
 public:
  std::size_t add(const std::string& bytes) {
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_ += bytes;
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    return views_.size() - 1;
  }
  Json add(const TileBits& bits) { return {{"bitstream", add(bits.bytes())}, {"availableCount", bits.count()}}; }
  [[nodiscard]] const Json& views() const { return views_; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Json views_ = Json::array();
  std::string bytes_;
};

constexpr const char *class_of_tiles = "tile", *property_of_error = "geometricError";

/// The schema of the tiles' metadata, which overrides what follows from their level.
Json schema() {
  const Json error = {{"type", "SCALAR"}, {"componentType", "FLOAT64"}, {"semantic", "TILE_GEOMETRIC_ERROR"}, {"required", true}};
  return {{"id", "farlod"}, {"classes", {{class_of_tiles, {{"properties", {{property_of_error, error}}}}}}}};
}

/// A row for each tile that is there, in the order of their bits.
Json errors_of_tiles(const TileTree& tree, const TileAddress& root, std::size_t tiles, SubtreeBuffer& buffer) {
  std::string errors;
  for (std::uint32_t depth = 0; depth < levels_of_subtree; ++depth)
    for (std::uint32_t place = 0; place < 1U << (2 * depth); ++place)
      if (tree.contains(tile_of_morton(root, depth, place))) append_bytes(errors, tree.error_as_drawn_m(root.level + depth));
  return Json::array(
      {{{"class", class_of_tiles}, {"count", tiles}, {"properties", {{property_of_error, {{"values", buffer.add(errors)}}}}}}});
}

/// The box of the root: its centre, and half of its edges as vectors. Its axes are the grid's.
Json root_box(const ViewFrame& frame, const TileTree& tree) {
  const double half_m = 0.5 * tree.square_of({}).edge_m;
  const Point2d middle = frame.local_from_grid({half_m, half_m}), x = half_m * frame.grid_axes.x, y = half_m * frame.grid_axes.y;
  // A metre more, for what floats round
  const double half_height_m = 0.5 * (frame.high_local - frame.low_local) + 1.0;
  return {middle.x, middle.y, 0.5 * (frame.low_local + frame.high_local), x.x, x.y, 0.0, y.x, y.y, 0.0, 0.0, 0.0, half_height_m};
}

}  // namespace

TileTree::TileTree(const ViewFrame& frame) : cells_(frame.cells), cell_edge_m_(frame.cell_edge_m) {
  const auto widest =
      static_cast<std::uint32_t>(std::max({1, frame.cells.i_end - frame.cells.i_begin, frame.cells.j_end - frame.cells.j_begin}));
  while ((1U << level_of_cells_) < widest) ++level_of_cells_;
}

TileTree TileTree::down_to_cells() const {
  TileTree tree = *this;
  tree.levels_within_cells_ = 0;
  return tree;
}

TileSquare TileTree::square_of(const TileAddress& tile) const {
  const double edge_m = std::ldexp(cell_edge_m_, static_cast<int>(level_of_cells_) - static_cast<int>(tile.level));
  return {{tile.x * edge_m, tile.y * edge_m}, edge_m};
}

bool TileTree::contains(const TileAddress& tile) const {
  if (tile.level >= levels() || tile.x >> tile.level != 0 || tile.y >> tile.level != 0) return false;
  const Point2d low = square_of(tile).low;
  return low.x < (cells_.i_end - cells_.i_begin) * cell_edge_m_ && low.y < (cells_.j_end - cells_.j_begin) * cell_edge_m_;
}

std::vector<TileAddress> TileTree::largest_tiles_from_the_middle(std::size_t most) const {
  const std::uint32_t level = first_level_with_content();
  const Point2d middle =
      0.5 * cell_edge_m_ *
      Point2d{static_cast<double>(cells_.i_end - cells_.i_begin), static_cast<double>(cells_.j_end - cells_.j_begin)};
  const auto distance = [&](const TileAddress& tile) {
    const auto [low, edge_m] = square_of(tile);
    return norm(low + 0.5 * Point2d{edge_m, edge_m} - middle);
  };
  std::vector<TileAddress> tiles;
  for (std::uint32_t y = 0; y < 1U << level; ++y)
    for (std::uint32_t x = 0; x < 1U << level; ++x)
      if (has_content({level, x, y})) tiles.push_back({level, x, y});
  std::ranges::stable_sort(tiles, {}, distance);
  tiles.resize(std::min(most, tiles.size()));
  return tiles;
}

CellRectangle TileTree::cells_of(const TileAddress& tile) const {
  const auto first_of = [&](std::uint32_t n) {
    return static_cast<std::int32_t>(tile.level >= level_of_cells_ ? n >> (tile.level - level_of_cells_)
                                                                   : n << (level_of_cells_ - tile.level));
  };
  const std::int32_t along = tile.level >= level_of_cells_ ? 1 : 1 << (level_of_cells_ - tile.level);
  const std::int32_t i = cells_.i_begin + first_of(tile.x), j = cells_.j_begin + first_of(tile.y);
  return {i, j, std::min(i + along, cells_.i_end), std::min(j + along, cells_.j_end)};
}

double TileTree::geometric_error_m(std::uint32_t level) const {
  return std::ldexp(error_of_cells_m, static_cast<int>(level_of_cells_) - static_cast<int>(level));
}

double TileTree::error_as_drawn_m(std::uint32_t level) const {
  const double error_m = geometric_error_m(level);
  return level >= first_level_with_content() ? error_m : std::max(error_m, square_of({level, 0, 0}).edge_m);
}

std::string tileset_json(const ViewFrame& frame, const TileTree& tree, const std::array<double, 16>& ecef_from_local) {
  const Json implicit = {{"subdivisionScheme", "QUADTREE"},
                         {"availableLevels", tree.levels()},
                         {"subtreeLevels", levels_of_subtree},
                         {"subtrees", {{"uri", "subtrees/{level}.{x}.{y}.subtree"}}}};
  const Json root = {{"boundingVolume", {{"box", root_box(frame, tree)}}},
                     {"geometricError", tree.geometric_error_m(0)},
                     {"refine", "REPLACE"},
                     {"transform", ecef_from_local},
                     {"content", {{"uri", "tiles/{level}/{x}/{y}.glb"}}},
                     {"implicitTiling", implicit}};
  // The error of the tileset is that of a picture without it
  const double of_nothing_m = std::max(2.0 * tree.geometric_error_m(0), tree.square_of({}).edge_m);
  return Json{{"asset", {{"version", "1.1"}}}, {"schema", schema()}, {"geometricError", of_nothing_m}, {"root", root}}.dump() +
         "\n";
}

std::string subtree_file(const TileTree& tree, const TileAddress& root) {
  const SubtreeBits bits = bits_of(tree, root);
  SubtreeBuffer buffer;
  Json json = {{"tileAvailability", buffer.add(bits.tiles)}, {"contentAvailability", Json::array({buffer.add(bits.contents)})}};
  json["childSubtreeAvailability"] = bits.children.count() > 0 ? buffer.add(bits.children) : Json{{"constant", 0}};
  if (root.level < tree.first_level_with_content()) {
    json["propertyTables"] = errors_of_tiles(tree, root, bits.tiles.count(), buffer);
    json["tileMetadata"] = 0;
  }
  json["buffers"] = Json::array({{{"byteLength", buffer.bytes().size()}}});
  json["bufferViews"] = buffer.views();
  std::string text = json.dump();
  text.resize((text.size() + 7) / 8 * 8, ' ');
  std::string file = "subt";
  append_bytes(file, std::uint32_t{1});
  append_bytes(file, std::uint64_t{text.size()});
  append_bytes(file, std::uint64_t{buffer.bytes().size()});
  return file + text + buffer.bytes();
}

}  // namespace farlod
