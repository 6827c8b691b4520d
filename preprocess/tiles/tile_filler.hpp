// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "base/paging/paged_array.hpp"
#include "package/horizon_edge.hpp"
#include "package/tile_set.hpp"

namespace farlod::tiles {

/// Words that belong to blocks, noted down in the order in which they come: chunk after chunk, since the blocks' words mix.
class BlockNotes {
 public:
  explicit BlockNotes(std::size_t blocks) : chunks_of_(blocks) {}

  void add(std::size_t block, std::span<const std::uint32_t> words);
  /// Calls visit(span) for each chunk of a block, in order.
  template <class Visit>
  void visit_chunks(std::size_t block, const Visit& visit) const {
    const Chunks& chunks = chunks_of_[block];
    for (std::size_t n = 0; n < chunks.begins.size(); ++n)
      visit(std::span(words_).subspan(chunks.begins[n], n + 1 < chunks.begins.size() ? chunk_words : chunks.used_of_last));
  }
  void let_go() const { words_.let_go(); }

 private:
  static constexpr std::size_t chunk_words = 4096;
  struct Chunks {
    std::vector<std::uint64_t> begins;
    std::size_t used_of_last = chunk_words;
  };
  PagedArray<std::uint32_t> words_;
  std::vector<Chunks> chunks_of_;
};

/// Gathers polygons and edges for the tiles of a city in whatever order they come, and fills the tiles with them, block by block
/// and in parallel. In each tile they stay in the order in which they came. Long cities are gathered on disk (PagedArray).
class TileFiller {
 public:
  explicit TileFiller(const Grid& grid);

  /// Convex; it becomes a fan of triangles, as with Tile::add_polygon. The cell must be one of the grid.
  void add_polygon(Cell cell, std::span<const Point3f> polygon, std::uint32_t surface);
  void add_edge(Cell cell, const HorizonEdge& edge);
  /// What comes from now on is left to readers: Tile::of_readers.
  void end_stored_polygons() { stored_polygons_ = counts_; }
  void end_stored_edges() { stored_edges_ = counts_; }

  /// Fills the meshes of the tiles, one for each cell of the grid. Called again once more polygons have been added.
  void fill_meshes(TileSet& tiles);
  /// Fills the edges of the tiles. Called last: polygons can be added no more.
  void fill_edges(TileSet& tiles);

 private:
  struct Counts {
    std::size_t vertices = 0, triangles = 0, edges = 0;
  };

  [[nodiscard]] std::size_t block_number(Cell cell) const;
  [[nodiscard]] std::vector<Counts> begins_of_tiles() const;
  void fill_mesh_of_block(std::size_t block, const std::vector<Counts>& begins, TileSet& tiles);
  void fill_edges_of_block(std::size_t block, const std::vector<Counts>& begins, TileSet& tiles);
  void fill_polygon(std::span<const Point3f> polygon, std::uint32_t surface, const Counts& begin, Counts& filled, Tile& tile);
  void view_mesh(const Counts& begin, const Counts& count, Tile& tile) const;
  void let_go(const BlockNotes& notes) const;

  const Grid& grid_;
  std::vector<Block> blocks_;
  std::size_t blocks_in_row_ = 0;
  std::vector<Counts> counts_;                          ///< of each tile, in the order of CellRange::index_of
  std::vector<Counts> stored_polygons_, stored_edges_;  ///< the same of what is stored; empty where all is
  BlockNotes polygons_, edges_;
  std::vector<std::uint32_t> words_;  ///< of the polygon that is added
  std::shared_ptr<TilePages> pages_ = std::make_shared<TilePages>();
};

}  // namespace farlod::tiles
