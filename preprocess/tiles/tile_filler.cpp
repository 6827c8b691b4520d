// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/tile_filler.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/expects.hpp"

namespace farlod::tiles {
namespace {

/// The words that come before the points of a polygon: its cell, its surface, and the number of its points.
using PolygonHead = std::array<std::uint32_t, 3>;
using PointWords = std::array<std::uint32_t, 3>;
/// An edge, and before it its cell.
using EdgeWords = std::array<std::uint32_t, sizeof(HorizonEdge) / sizeof(std::uint32_t)>;

/// Takes apart the words of a block, which chunks may divide anywhere.
class NoteReader {
 public:
  NoteReader(const BlockNotes& notes, std::size_t block) {
    notes.visit_chunks(block, [this](std::span<const std::uint32_t> chunk) { chunks_.push_back(chunk); });
  }
  [[nodiscard]] bool is_at_end() const { return chunk_ == chunks_.size(); }
  /// Since this was last asked, so much was read that it should be let go.
  [[nodiscard]] bool has_read_much() { return chunk_ >= next_pause_ && (next_pause_ = chunk_ + chunks_between_pauses) > 0; }
  template <std::size_t count>
  std::array<std::uint32_t, count> take() {
    std::array<std::uint32_t, count> words;
    if (chunks_[chunk_].size() - place_ > count) {
      std::copy_n(chunks_[chunk_].begin() + static_cast<std::ptrdiff_t>(place_), count, words.begin());
      place_ += count;
    } else {
      for (std::uint32_t& word : words) word = next();
    }
    return words;
  }

 private:
  std::uint32_t next() {
    const std::uint32_t word = chunks_[chunk_][place_++];
    if (place_ == chunks_[chunk_].size()) {
      ++chunk_;
      place_ = 0;
    }
    return word;
  }

  static constexpr std::size_t chunks_between_pauses = 128;  // 2 MiB
  std::vector<std::span<const std::uint32_t>> chunks_;
  std::size_t chunk_ = 0, place_ = 0, next_pause_ = chunks_between_pauses;
};

}  // namespace

void BlockNotes::add(std::size_t block, std::span<const std::uint32_t> words) {
  Chunks& chunks = chunks_of_[block];
  while (!words.empty()) {
    if (chunks.used_of_last == chunk_words) {
      chunks.begins.push_back(words_.size());
      chunks.used_of_last = 0;
      words_.resize_for_overwrite(words_.size() + chunk_words);
    }
    const std::size_t count = std::min(words.size(), chunk_words - chunks.used_of_last);
    std::copy_n(words.begin(), count, words_.begin() + chunks.begins.back() + chunks.used_of_last);
    chunks.used_of_last += count;
    words = words.subspan(count);
  }
}

TileFiller::TileFiller(const Grid& grid)
    : grid_(grid),
      blocks_(grid.blocks()),
      counts_(static_cast<std::size_t>(grid.cells.size())),
      polygons_(blocks_.size()),
      edges_(blocks_.size()) {
  for (const Block block : blocks_) blocks_in_row_ += block.j == blocks_.front().j ? 1U : 0U;
}

std::size_t TileFiller::block_number(Cell cell) const {
  const Block block = grid_.block_of(cell), first = blocks_.front();
  return static_cast<std::size_t>(block.j - first.j) * blocks_in_row_ + static_cast<std::size_t>(block.i - first.i);
}

void TileFiller::add_polygon(Cell cell, std::span<const Point3f> polygon, std::uint32_t surface) {
  const std::size_t tile = grid_.cells.index_of(cell), block = block_number(cell);
  counts_[tile].vertices += polygon.size();
  counts_[tile].triangles += std::max<std::size_t>(polygon.size(), 2) - 2;
  polygons_.add(block, PolygonHead{static_cast<std::uint32_t>(tile), surface, static_cast<std::uint32_t>(polygon.size())});
  static_assert(sizeof(Point3f) == sizeof(PointWords));
  words_.resize(polygon.size() * std::tuple_size_v<PointWords>);
  std::memcpy(words_.data(), polygon.data(), polygon.size_bytes());
  polygons_.add(block, words_);
}

void TileFiller::add_edge(Cell cell, const HorizonEdge& edge) {
  const std::size_t tile = grid_.cells.index_of(cell), block = block_number(cell);
  ++counts_[tile].edges;
  edges_.add(block, std::array{static_cast<std::uint32_t>(tile)});
  edges_.add(block, std::bit_cast<EdgeWords>(edge));
}

/// The tiles of a block lie side by side.
std::vector<TileFiller::Counts> TileFiller::begins_of_tiles() const {
  std::vector<Counts> begins(counts_.size());
  Counts sum;
  for (const Block block : blocks_) {
    const CellRange cells = grid_.cells_of(block);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
      const std::size_t tile = grid_.cells.index_of(cells.cell_at(n));
      begins[tile] = sum;
      sum = {sum.vertices + counts_[tile].vertices, sum.triangles + counts_[tile].triangles, sum.edges + counts_[tile].edges};
    }
  }
  begins.push_back(sum);
  return begins;
}

void TileFiller::fill_meshes(TileSet& tiles) {
  const std::vector<Counts> begins = begins_of_tiles();
  pages_->vertices.resize_for_overwrite(begins.back().vertices);
  pages_->triangles.resize_for_overwrite(begins.back().triangles);
  pages_->triangle_surfaces.resize_for_overwrite(begins.back().triangles);
  tiles.pages = pages_;
  oneapi::tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t n) { fill_mesh_of_block(n, begins, tiles); });
}

void TileFiller::fill_mesh_of_block(std::size_t block, const std::vector<Counts>& begins, TileSet& tiles) {
  const CellRange cells = grid_.cells_of(blocks_[block]);
  std::vector<Counts> filled(static_cast<std::size_t>(cells.size()));
  std::vector<Point3f> polygon;
  for (NoteReader notes(polygons_, block); !notes.is_at_end();) {
    if (notes.has_read_much()) let_go(polygons_);
    const auto [number, surface, corners] = notes.take<3>();
    polygon.resize(corners);
    for (Point3f& p : polygon) p = std::bit_cast<Point3f>(notes.take<3>());
    fill_polygon(polygon, surface, begins[number], filled[cells.index_of(grid_.cells.cell_at(number))], tiles.tiles[number]);
  }
  for (std::size_t n = 0; n < filled.size(); ++n) {
    const std::size_t number = grid_.cells.index_of(cells.cell_at(n));
    Tile& tile = tiles.tiles[number];
    view_mesh(begins[number], filled[n], tile);
    if (!stored_polygons_.empty()) tile.of_readers.triangles = filled[n].triangles - stored_polygons_[number].triangles;
  }
  let_go(polygons_);
}

/// Writes a polygon behind those of its tile that `filled` counts.
void TileFiller::fill_polygon(std::span<const Point3f> polygon, std::uint32_t surface, const Counts& begin, Counts& filled,
                              Tile& tile) {
  const auto first = static_cast<std::uint32_t>(filled.vertices);
  for (const Point3f& p : polygon) {
    pages_->vertices[begin.vertices + filled.vertices++] = p;
    tile.z_low_m = std::min(tile.z_low_m, p.z);
    tile.z_high_m = std::max(tile.z_high_m, p.z);
  }
  for (std::uint32_t n = 2; n < polygon.size(); ++n) {
    const std::size_t place = begin.triangles + filled.triangles++;
    pages_->triangles[place] = {first, first + n - 1, first + n};
    pages_->triangle_surfaces[place] = surface;
  }
}

void TileFiller::view_mesh(const Counts& begin, const Counts& count, Tile& tile) const {
  tile.vertices = TileArray<Point3f>::view_of({pages_->vertices.data() + begin.vertices, count.vertices});
  tile.triangles = TileArray<Triangle>::view_of({pages_->triangles.data() + begin.triangles, count.triangles});
  tile.triangle_surfaces =
      TileArray<std::uint32_t>::view_of({pages_->triangle_surfaces.data() + begin.triangles, count.triangles});
}

void TileFiller::fill_edges(TileSet& tiles) {
  polygons_ = BlockNotes(blocks_.size());
  const std::vector<Counts> begins = begins_of_tiles();
  pages_->horizon_edges.resize_for_overwrite(begins.back().edges);
  oneapi::tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t n) { fill_edges_of_block(n, begins, tiles); });
  edges_ = BlockNotes(blocks_.size());
}

void TileFiller::fill_edges_of_block(std::size_t block, const std::vector<Counts>& begins, TileSet& tiles) {
  const CellRange cells = grid_.cells_of(blocks_[block]);
  std::vector<std::size_t> filled(static_cast<std::size_t>(cells.size()), 0);
  for (NoteReader notes(edges_, block); !notes.is_at_end();) {
    const auto [number] = notes.take<1>();
    std::size_t& done = filled[cells.index_of(grid_.cells.cell_at(number))];
    pages_->horizon_edges[begins[number].edges + done++] = std::bit_cast<HorizonEdge>(notes.take<std::tuple_size_v<EdgeWords>>());
  }
  for (std::size_t n = 0; n < filled.size(); ++n) {
    const std::size_t number = grid_.cells.index_of(cells.cell_at(n));
    tiles.tiles[number].horizon_edges =
        TileArray<HorizonEdge>::view_of({pages_->horizon_edges.data() + begins[number].edges, filled[n]});
    if (!stored_edges_.empty()) tiles.tiles[number].of_readers.edges = filled[n] - stored_edges_[number].edges;
  }
  let_go(edges_);
}

void TileFiller::let_go(const BlockNotes& notes) const {
  notes.let_go();
  pages_->let_go();
}

}  // namespace farlod::tiles
