// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "view/tile_tree.hpp"

namespace farlod {
namespace {

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

template <class Number>
void append_little_endian(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

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
      if (tree.contains(tile_of_morton(root, depth, place)))
        append_little_endian(errors, tree.error_as_drawn_m(root.level + depth));
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
  append_little_endian(file, std::uint32_t{1});
  append_little_endian(file, std::uint64_t{text.size()});
  append_little_endian(file, std::uint64_t{buffer.bytes().size()});
  return file + text + buffer.bytes();
}

}  // namespace farlod
