// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/tiles_writer.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

using package::TileEdge;

/// Edges that have not been met among the sides of the triangles. Edges and sides may run against each other.
class UnmetEdges {
 public:
  UnmetEdges(std::span<const HorizonEdge> edges, const SharedVertices& vertices)
      : edges_(edges), is_met_(edges.size()), begin_of_vertex_(vertices.vertices().size() + 1) {
    std::vector<std::optional<Entry>> found(edges.size());
    for (std::size_t n = 0; n < edges.size(); ++n) {
      const auto a = vertices.find(edges[n].a), b = vertices.find(edges[n].b);
      if (!a || !b) continue;
      const auto [low, high] = std::minmax(*a, *b);
      found[n] = Entry{static_cast<std::uint32_t>(n), *a, low, high};
      ++begin_of_vertex_[low + 1];
    }
    // Sort them by their lower vertex; those of one vertex keep their order
    std::partial_sum(begin_of_vertex_.begin(), begin_of_vertex_.end(), begin_of_vertex_.begin());
    entries_.resize(begin_of_vertex_.back());
    std::vector<std::uint32_t> next = begin_of_vertex_;
    for (std::size_t n = 0; n < edges.size(); ++n)
      if (found[n]) entries_[next[found[n]->low]++] = *found[n];
  }

  /// The adjacent slopes along the side, if it is an edge; those of the first one, if it is several.
  std::optional<AdjacentSlopes> meet(std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(from, to);
    for (std::uint32_t k = begin_of_vertex_[low]; k < begin_of_vertex_[low + 1]; ++k) {
      const Entry& entry = entries_[k];
      if (entry.high != high || is_met_[entry.edge]) continue;
      is_met_[entry.edge] = true;
      const AdjacentSlopes adjacent = edges_[entry.edge].adjacent;
      return entry.from == from ? adjacent : AdjacentSlopes{adjacent.right, adjacent.left};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<HorizonEdge> rest() const {
    std::vector<HorizonEdge> result;
    for (std::size_t n = 0; n < edges_.size(); ++n)
      if (!is_met_[n]) result.push_back(edges_[n]);
    return result;
  }

 private:
  struct Entry {
    std::uint32_t edge = 0, from = 0;  ///< `from`: the vertex where it begins
    std::uint32_t low = 0, high = 0;   ///< its vertices, the lower number first
  };
  std::span<const HorizonEdge> edges_;
  std::vector<bool> is_met_;
  std::vector<std::uint32_t> begin_of_vertex_;  ///< of the entries whose lower vertex it is
  std::vector<Entry> entries_;
};

}  // namespace

SideEdges side_edges(std::span<const HorizonEdge> edges, std::span<const Triangle> triangles, const SharedVertices& vertices) {
  SideEdges result;
  if (edges.empty()) return result;
  UnmetEdges unmet(edges, vertices);
  std::size_t skipped = 0;
  for (const Triangle& t : triangles)
    for (const auto& [from, to] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
      const std::optional<AdjacentSlopes> adjacent = unmet.meet(from, to);
      if (!adjacent) {
        ++skipped;
        continue;
      }
      // What one entry cannot skip, entries without an edge do
      for (; skipped >= TileEdge::skip_only; skipped -= TileEdge::skip_only)
        result.sides.push_back({TileEdge::skip_only, AdjacentSlopes{0, 0}});
      result.sides.push_back({static_cast<std::uint8_t>(skipped), *adjacent});
      skipped = 0;
    }
  result.loose = unmet.rest();
  return result;
}

namespace {

using namespace package;

/// The sections of a block, gathered cell by cell. Surfaces and buildings are numbered anew, by their order in the city, so that
/// a block knows only those that it holds.
class BlockSections {
 public:
  BlockSections(const TileSet& tiles, const CellRange& range) : city_(tiles) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n)
      for (const std::uint32_t s : tiles.tile(range.cell_at(n)).triangle_surfaces)
        if (surface_numbers_.empty() || surface_numbers_.back() != s) surface_numbers_.push_back(s);
    // Readers add triangles of the ground, even where the tiles have no others here
    if (tiles.squares_of_readers > 0) surface_numbers_.push_back(ground_surface);
    std::sort(surface_numbers_.begin(), surface_numbers_.end());
    surface_numbers_.erase(std::unique(surface_numbers_.begin(), surface_numbers_.end()), surface_numbers_.end());
    for (const std::uint32_t number : surface_numbers_) surfaces.push_back(record_of(city_.surfaces[number]));
  }

  void add_cell(Cell cell) {
    const Tile& tile = city_.tile(cell);
    CellRecord record{};
    record.i = cell.i;
    record.j = cell.j;
    record.triangle_count = static_cast<std::uint32_t>(tile.stored_triangles().size());
    add_geometry(tile, record);
    add_runs(tile);
    cells.push_back(record);
  }

  static void describe_map(CellRecord& cell, const BakedBox& map) {
    cell.capture_x_m = map.capture_cell.x;
    cell.capture_y_m = map.capture_cell.y;
    cell.capture_z_m = map.capture_cell.z;
    cell.far_map_top = map.shape.top;
  }

  void add_map(const BakedHorizon& map) {
    FarCellRecord record{};
    record.first_explicit_edge = explicit_edges.size();
    record.explicit_edge_count = static_cast<std::uint32_t>(map.explicit_edges.size());
    const std::vector<float>& levels_m = map.patches.levels_m();
    FARLOD_EXPECTS(levels_m.size() <= record.levels_m.size());
    for (std::size_t l = 0; l < record.levels_m.size(); ++l) record.levels_m[l] = levels_m[std::min(l, levels_m.size() - 1)];
    far_cells.push_back(record);
    explicit_edges.insert(explicit_edges.end(), map.explicit_edges.begin(), map.explicit_edges.end());
  }

  /// Adds a cell without a far map, where others have one.
  void add_missing_map() { far_cells.push_back({explicit_edges.size(), 0, {}, 0}); }

  /// Calls visit(kind, elements) for each section, in the order of the file.
  template <class Visit>
  void visit(const Visit& visit) {
    visit(SectionKind::cells, cells);
    visit(SectionKind::vertices, vertices);
    visit(SectionKind::triangles, triangles);
    visit(SectionKind::surface_runs, surface_runs);
    visit(SectionKind::surfaces, surfaces);
    visit(SectionKind::buildings, buildings);
    visit(SectionKind::text, text);
    visit(SectionKind::far_cells, far_cells);
    visit(SectionKind::far_edges, far_edges);
    visit(SectionKind::explicit_edges, explicit_edges);
    visit(SectionKind::tile_edges, tile_edges);
    visit(SectionKind::loose_edges, loose_edges);
  }

  std::vector<CellRecord> cells;
  std::vector<FarCellRecord> far_cells;
  std::vector<HorizonEdge> far_edges;
  std::vector<ExplicitOccluder> explicit_edges;
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<SurfaceRun> surface_runs;
  std::vector<TileEdge> tile_edges;
  std::vector<HorizonEdge> loose_edges;
  std::vector<SurfaceRecord> surfaces;
  std::vector<BuildingRecord> buildings;
  std::string text;

 private:
  void add_geometry(const Tile& tile, CellRecord& cell) {
    SharedVertices shared;
    const auto corner = [&](std::uint32_t vertex) { return shared.number_of(tile.vertices[vertex]); };
    for (const Triangle& t : tile.stored_triangles()) triangles.push_back(Triangle{corner(t.a), corner(t.b), corner(t.c)});
    for (std::size_t role = 0; role < edge_role_count; ++role) {
      std::vector<HorizonEdge> edges;
      std::ranges::copy_if(tile.stored_edges(), std::back_inserter(edges),
                           [role](const HorizonEdge& e) { return static_cast<std::size_t>(e.role) == role; });
      const SideEdges placed = side_edges(edges, std::span(triangles).last(cell.triangle_count), shared);
      cell.edge_counts[role] = static_cast<std::uint32_t>(placed.sides.size());
      cell.loose_edge_count += static_cast<std::uint32_t>(placed.loose.size());
      tile_edges.insert(tile_edges.end(), placed.sides.begin(), placed.sides.end());
      loose_edges.insert(loose_edges.end(), placed.loose.begin(), placed.loose.end());
    }
    cell.vertex_count = static_cast<std::uint32_t>(shared.vertices().size());
    cell.z_low_m = std::numeric_limits<float>::infinity();
    cell.z_high_m = -cell.z_low_m;
    for (const Point3f& p : shared.vertices()) {
      cell.z_low_m = std::min(cell.z_low_m, p.z);
      cell.z_high_m = std::max(cell.z_high_m, p.z);
    }
    vertices.insert(vertices.end(), shared.vertices().begin(), shared.vertices().end());
  }

  void add_runs(const Tile& tile) {
    const std::span numbers(tile.triangle_surfaces.data(), tile.stored_triangles().size());
    for (std::uint32_t t = 0; t < numbers.size(); ++t) {
      const bool ends = t + 1 == numbers.size() || numbers[t + 1] != numbers[t];
      if (ends) surface_runs.push_back(SurfaceRun{row_of_surface(numbers[t]), t + 1});
    }
  }

  [[nodiscard]] std::uint32_t row_of_surface(std::uint32_t number) const {
    const auto found = std::lower_bound(surface_numbers_.begin(), surface_numbers_.end(), number);
    return static_cast<std::uint32_t>(found - surface_numbers_.begin());
  }

  SurfaceRecord record_of(const Surface& s) {
    SurfaceRecord record{};
    record.building = s.building == ground_building ? no_building : row_of_building(s.building);
    record.number = s.number;
    record.part = s.part;
    record.pack(s.kind, s.grounded, OctNormal::nearest_to(s.normal));
    return record;
  }
  std::uint32_t row_of_building(std::uint32_t number) {
    const auto [entry, is_new] = row_of_building_.try_emplace(number, static_cast<std::uint32_t>(buildings.size()));
    if (is_new) {
      const std::string& id = city_.building_ids[number];
      buildings.push_back({static_cast<std::uint32_t>(text.size()), static_cast<std::uint32_t>(id.size()), number});
      text += id;
      FARLOD_EXPECTS(text.size() <= std::numeric_limits<std::uint32_t>::max());
    }
    return entry->second;
  }

  const TileSet& city_;
  std::vector<std::uint32_t> surface_numbers_;  ///< in the city, of each row
  std::map<std::uint32_t, std::uint32_t> row_of_building_;
};

/// A file in memory: header, table of sections, then the sections at aligned places.
class TilesFile {
 public:
  /// `sections_bytes`: of all sections together.
  TilesFile(Block block, std::size_t sections_bytes) : bytes_(sizeof(Header) + section_count * sizeof(Section)) {
    header_.magic = magic;
    header_.version = tiles_version;
    header_.section_count = section_count;
    header_.block_i = block.i;
    header_.block_j = block.j;
    // A vector that grows holds old and new, and room for as much again
    bytes_.reserve(bytes_.size() + sections_bytes + section_count * section_alignment + end_padding);
  }

  /// Frees the elements: a block has many.
  template <class Elements>
  void take(SectionKind kind, Elements& elements) {
    using T = typename Elements::value_type;
    bytes_.resize((bytes_.size() + section_alignment - 1) / section_alignment * section_alignment);
    table_.push_back({kind, sizeof(T), bytes_.size(), elements.size(), 0});
    const auto* begin = reinterpret_cast<const std::byte*>(elements.data());
    bytes_.insert(bytes_.end(), begin, begin + elements.size() * sizeof(T));
    elements = Elements();
  }

  std::vector<std::byte> finish() {
    FARLOD_EXPECTS(table_.size() == section_count);
    bytes_.resize(bytes_.size() + end_padding);
    header_.file_bytes = bytes_.size();
    std::memcpy(bytes_.data(), &header_, sizeof(Header));
    std::memcpy(bytes_.data() + sizeof(Header), table_.data(), table_.size() * sizeof(Section));
    return std::move(bytes_);
  }

 private:
  Header header_{};
  std::vector<Section> table_;
  std::vector<std::byte> bytes_;
};

void add_far_maps(BlockSections& sections, const BakedBlock& maps, const std::vector<std::size_t>& places) {
  if (const auto* boxes = std::get_if<BakedBoxes>(&maps)) {
    FARLOD_EXPECTS(boxes->size() == places.size());
    for (std::size_t n = 0; n < places.size(); ++n) sections.describe_map(sections.cells[places[n]], (*boxes)[n]);
    return;
  }
  const auto& horizons = std::get<BakedHorizons>(maps);
  FARLOD_EXPECTS(horizons.cells.size() == places.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    while (sections.far_cells.size() < places[n]) sections.add_missing_map();
    sections.add_map(horizons.cells[n]);
  }
  while (sections.far_cells.size() < sections.cells.size()) sections.add_missing_map();
  sections.far_edges = horizons.edges;
}

}  // namespace

std::vector<std::byte> tiles_file(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                  const std::optional<CellRuns>& mapped) {
  const CellRange range = grid.cells_of(block);
  BlockSections sections(tiles, range);
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) sections.add_cell(range.cell_at(n));
  const CellRuns all{{{0, static_cast<std::uint32_t>(range.size())}}};
  add_far_maps(sections, maps, mapped.value_or(all).places());
  std::size_t bytes = 0;
  sections.visit([&](SectionKind, const auto& elements) { bytes += elements.size() * sizeof(elements[0]); });
  TilesFile file(block, bytes);
  sections.visit([&](SectionKind kind, auto& elements) { file.take(kind, elements); });
  return file.finish();
}

std::vector<std::byte> tiles_file_without_maps(const TileSet& tiles, const Grid& grid, Block block) {
  // Far maps of the kind `box` add nothing but their capture points
  return farlod::tiles_file(tiles, BakedBoxes(static_cast<std::size_t>(grid.cells_of(block).size())), grid, block);
}

}  // namespace farlod
