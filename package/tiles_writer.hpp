// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/grid.hpp"
#include "base/mesh_view.hpp"
#include "farlod/point.hpp"
#include "package/far_map.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// The vertices of one tile, each once. Vertices are one when they are equal bit for bit: those that lie close together stay
/// apart. Numbers go by the order in which places are first asked for.
class SharedVertices {
 public:
  [[nodiscard]] std::uint32_t number_of(const Point3f& p_cell) {
    const auto [entry, is_new] = numbers_.try_emplace(bits_of(p_cell), static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(p_cell);
    return entry->second;
  }
  /// Its number, if it has been asked for.
  [[nodiscard]] std::optional<std::uint32_t> find(const Point3f& p_cell) const {
    const auto entry = numbers_.find(bits_of(p_cell));
    return entry == numbers_.end() ? std::nullopt : std::optional(entry->second);
  }
  [[nodiscard]] const std::vector<Point3f>& vertices() const { return vertices_; }

 private:
  using Bits = std::array<std::uint32_t, 3>;
  static Bits bits_of(const Point3f& p) { return std::bit_cast<Bits>(p); }
  struct Hash {
    std::size_t operator()(const Bits& bits) const {
      // The multiplier of splitmix64 (Steele et al. 2014), so that the few bits in which neighbors differ reach all others
      std::uint64_t sum = 0;
      for (const std::uint32_t part : bits) {
        sum = (sum ^ part) * 0xBF58476D1CE4E5B9U;
        sum ^= sum >> 31U;
      }
      return sum;
    }
  };

  std::vector<Point3f> vertices_;
  std::unordered_map<Bits, std::uint32_t, Hash> numbers_;
};

/// The horizon edges of a tile as they are written. Nearly all are sides of its triangles. The rest was rounded elsewhere: an
/// edge is cut at the borders of cells in double precision, a triangle exactly.
struct SideEdges {
  std::vector<package::TileEdge> sides;
  std::vector<HorizonEdge> loose;
};

/// Each edge once: as the first side of `triangles` that has its ends and is no other edge, otherwise loose. An edge that runs
/// against its side is turned round.
[[nodiscard]] SideEdges side_edges(std::span<const HorizonEdge> edges, std::span<const Triangle> triangles,
                                   const SharedVertices& vertices);

/// The bytes of a block's `tiles.bin` (package/layout.hpp), with the explicit occluders of its far maps. `maps` are
/// those of the cells `mapped`, in their order; of all cells where `mapped` is absent.
[[nodiscard]] std::vector<std::byte> tiles_file(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                                const std::optional<package::CellRuns>& mapped = {});

/// The same without far maps: of a block that has none, or to be read together with maps that are not in a file.
[[nodiscard]] std::vector<std::byte> tiles_file_without_maps(const TileSet& tiles, const Grid& grid, Block block);

}  // namespace farlod
