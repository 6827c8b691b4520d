// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/block_tiles.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/expects.hpp"

namespace farlod {

using namespace package;

namespace {

/// −128 is no angle: its tangent would come out on the other side of the vertical.
bool are_angles(AdjacentSlopes adjacent) {
  return adjacent.left >= AdjacentSlopes::straight_down && adjacent.right >= AdjacentSlopes::straight_down;
}

}  // namespace

BlockTiles::BlockTiles(std::span<const std::byte> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {
  check_header();
  const auto* header = reinterpret_cast<const Header*>(bytes_.data());
  sections_ = {reinterpret_cast<const Section*>(bytes_.data() + sizeof(Header)), header->section_count};
}

BlockTiles::BlockTiles(std::span<const std::byte> bytes, const CellRange& cells, std::string name)
    : BlockTiles(bytes, std::move(name)) {
  range_ = cells;
  find_sections();
  check_surfaces();
  check_cells();
  place_tiles();
  for (const TileView& tile : tiles_) check_tile(tile);
  check_far_cells();
  check_far_places();
}

std::span<const CellRecord> BlockTiles::records_of_cells(std::span<const std::byte> bytes, std::string name) {
  return BlockTiles(bytes, std::move(name)).section<CellRecord>(SectionKind::cells);
}

void BlockTiles::check_header() const {
  require(bytes_.size() >= sizeof(Header), "it is shorter than its header");
  const auto* header = reinterpret_cast<const Header*>(bytes_.data());
  require(header->magic == magic, "it does not begin as a tiles file");
  require_readable_version(name_, header->version, tiles_version, tiles_version);
  require(header->file_bytes == bytes_.size(), "its length is not what its header says");
  require(header->section_count <= (bytes_.size() - sizeof(Header)) / sizeof(Section), "its table of sections is cut off");
}

void BlockTiles::find_sections() {
  cells_ = section<CellRecord>(SectionKind::cells);
  surfaces_ = section<SurfaceRecord>(SectionKind::surfaces);
  buildings_ = section<BuildingRecord>(SectionKind::buildings);
  const auto text = section<char>(SectionKind::text);
  text_ = {text.data(), text.size()};
  far_cells_ = section<FarCellRecord>(SectionKind::far_cells);
  far_edges_ = section<HorizonEdge>(SectionKind::far_edges);
  explicit_edges_ = section<ExplicitOccluder>(SectionKind::explicit_edges);
}

template <class T>
std::span<const T> BlockTiles::section(SectionKind kind) const {
  for (const Section& s : sections_) {
    if (s.kind != kind) continue;
    require(s.element_bytes == sizeof(T), "a section has elements of another size");
    require(s.offset % section_alignment == 0, "a section is not aligned");
    require(s.offset <= bytes_.size() && s.count <= (bytes_.size() - s.offset) / sizeof(T), "a section reaches beyond the end");
    return {reinterpret_cast<const T*>(bytes_.data() + s.offset), s.count};
  }
  require(false, "a section is missing");
  return {};
}

void BlockTiles::check_surfaces() const {
  std::uint64_t text_bytes = 0;
  for (const BuildingRecord& b : buildings_) {
    require(b.text_offset <= text_.size() && b.text_bytes <= text_.size() - b.text_offset,
            "a building's id reaches beyond the text");
    text_bytes += b.text_bytes;
  }
  // Or else the ids of a small file could take any amount of memory
  require(text_bytes <= text_.size(), "its buildings share the bytes of their ids");
  for (const SurfaceRecord& s : surfaces_) {
    require(s.building == no_building || s.building < buildings_.size(), "a surface names a building that does not exist");
    require(s.kind() >= SurfaceKind::ground && s.kind() <= SurfaceKind::foundation, "a surface is of a kind that does not exist");
  }
}

void BlockTiles::check_cells() const {
  require(cells_.size() == static_cast<std::size_t>(range_.size()), "it does not hold the cells of its block");
  for (std::size_t n = 0; n < cells_.size(); ++n) {
    const CellRecord& c = cells_[n];
    require(Cell{c.i, c.j} == range_.cell_at(n), "its cells are not in order");
    require(is_on_earth({c.capture_x_m, c.capture_y_m, c.capture_z_m}), "a capture point lies nowhere on Earth");
    require(std::isfinite(c.far_map_top) && c.far_map_top >= 0.0F, "a far map's height is not a number");
  }
}

void BlockTiles::place_tiles() {
  auto vertices = section<Point3f>(SectionKind::vertices);
  auto triangles = section<Triangle>(SectionKind::triangles);
  auto runs = section<SurfaceRun>(SectionKind::surface_runs);
  auto edges = section<TileEdge>(SectionKind::tile_edges);
  auto loose_edges = section<HorizonEdge>(SectionKind::loose_edges);
  tiles_.reserve(cells_.size());
  for (const CellRecord& c : cells_) {
    TileView tile{&c, {}, {}, surfaces_, buildings_, {}, {}};
    tile.mesh.vertices = cut_off(vertices, c.vertex_count, "a cell's vertices reach beyond the end");
    tile.mesh.triangles = cut_off(triangles, c.triangle_count, "a cell's triangles reach beyond the end");
    tile.surface_runs = cut_off(runs, run_count(runs, c.triangle_count), "a cell's surfaces reach beyond the end");
    for (std::size_t role = 0; role < edge_role_count; ++role)
      tile.edge_sides[role] = cut_off(edges, c.edge_counts[role], "a cell's edges reach beyond the end");
    tile.loose_edges = cut_off(loose_edges, c.loose_edge_count, "a cell's loose edges reach beyond the end");
    tiles_.push_back(tile);
  }
  require(vertices.empty() && triangles.empty() && runs.empty() && edges.empty() && loose_edges.empty(),
          "it holds more than its cells own");
}

template <class T>
std::span<const T> BlockTiles::cut_off(std::span<const T>& rest, std::size_t count, const char* what) const {
  require(count <= rest.size(), what);
  const auto front = rest.first(count);
  rest = rest.subspan(count);
  return front;
}

std::size_t BlockTiles::run_count(std::span<const SurfaceRun> runs, std::uint32_t triangle_count) const {
  std::size_t count = 0;
  for (std::uint32_t begin = 0; begin < triangle_count; ++count) {
    require(count < runs.size(), "not every triangle has a surface");
    const SurfaceRun& run = runs[count];
    require(begin < run.end && run.end <= triangle_count, "the runs of triangles of one surface are not in order");
    require(run.surface < surfaces_.size(), "a triangle names a surface that does not exist");
    begin = run.end;
  }
  return count;
}

void BlockTiles::check_tile(const TileView& tile) const {
  float z_low_m = std::numeric_limits<float>::infinity(), z_high_m = -z_low_m;
  for (const Point3f& p : tile.mesh.vertices) {
    require(is_on_earth(p), "a vertex lies nowhere on Earth");
    z_low_m = std::min(z_low_m, p.z);
    z_high_m = std::max(z_high_m, p.z);
  }
  const CellRecord& c = *tile.cell;
  const bool is_empty = c.vertex_count == 0;
  require(is_empty ? c.z_low_m > c.z_high_m : c.z_low_m == z_low_m && c.z_high_m == z_high_m,
          "a cell's heights are not those of its vertices");
  for (const Triangle& t : tile.mesh.triangles)
    require(t.a < c.vertex_count && t.b < c.vertex_count && t.c < c.vertex_count,
            "a triangle names a vertex that does not exist");
  check_edges(tile);
}

void BlockTiles::check_edges(const TileView& tile) const {
  for (const std::span<const TileEdge> of_role : tile.edge_sides) {
    std::uint64_t sides = 0;
    for (const TileEdge& e : of_role) {
      sides += e.sides_skipped + (e.sides_skipped == TileEdge::skip_only ? 0U : 1U);
      require(are_angles(e.adjacent), "something beside an edge rises beyond a right angle");
    }
    require(sides <= 3 * tile.mesh.triangles.size(), "an edge is a side of a triangle that does not exist");
  }
  check_places(tile.loose_edges);
}

void BlockTiles::check_places(std::span<const HorizonEdge> edges) const {
  for (const HorizonEdge& e : edges) {
    require(is_on_earth(e.a) && is_on_earth(e.b), "an edge lies nowhere on Earth");
    require(are_angles(e.adjacent), "something beside an edge rises beyond a right angle");
    require(static_cast<std::size_t>(e.role) < edge_role_count, "an edge has a role that does not exist");
  }
}

void BlockTiles::check_far_cells() const {
  require(far_cells_.empty() || far_cells_.size() == cells_.size(), "not every cell has a far map");
  for (const FarCellRecord& c : far_cells_) {
    require(c.first_explicit_edge <= explicit_edges_.size() &&
                c.explicit_edge_count <= explicit_edges_.size() - c.first_explicit_edge,
            "a far map's edges reach beyond the end");
    for (std::size_t l = 0; l < c.levels_m.size(); ++l)
      require(std::abs(c.levels_m[l]) <= farthest_in_tile_m && (l == 0 || c.levels_m[l - 1] <= c.levels_m[l]),
              "the levels of a far map are not in order");
  }
  for (const ExplicitOccluder& n : explicit_edges_)
    require(n.row < far_edges_.size(), "a far map names an edge that does not exist");
}

void BlockTiles::check_far_places() const { check_places(far_edges_); }

ExplicitOccluders BlockTiles::explicit_occluders(Cell cell, double cell_edge_m) const {
  FARLOD_EXPECTS(range_.contains(cell) && has_far_cells());
  const FarCellRecord& c = far_cells_[range_.index_of(cell)];
  return {far_edges_, explicit_edges_.subspan(c.first_explicit_edge, c.explicit_edge_count),
          Point2d{(range_.i_begin - cell.i) * cell_edge_m, (range_.j_begin - cell.j) * cell_edge_m}};
}

std::vector<float> BlockTiles::levels_m(Cell cell, std::uint32_t layers) const {
  FARLOD_EXPECTS(range_.contains(cell) && has_far_cells() && layers <= most_layers);
  const auto& levels = far_cells_[range_.index_of(cell)].levels_m;
  return {levels.begin(), levels.begin() + layers};
}

TileView BlockTiles::tile(Cell cell) const {
  FARLOD_EXPECTS(range_.contains(cell));
  return tiles_[range_.index_of(cell)];
}

}  // namespace farlod
