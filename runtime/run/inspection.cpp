// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/inspection.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "package/layout.hpp"
#include "run/existing_cell.hpp"
#include "run/package_contents.hpp"

namespace farlod {
namespace {

CellRectangle rectangle_of(const CellRange& range) { return {range.i_begin, range.j_begin, range.i_end, range.j_end}; }

void count_edges(const TileView& tile, CellContents& contents) {
  std::array<std::uint64_t, edge_role_count> counts{};
  tile.visit_edges([&](const HorizonEdge& e) { ++counts[static_cast<std::size_t>(e.role)]; });
  contents.grounded_edges = counts[static_cast<std::size_t>(EdgeRole::grounded)];
  contents.overhang_edges = counts[static_cast<std::size_t>(EdgeRole::overhang)];
  contents.underside_edges = counts[static_cast<std::size_t>(EdgeRole::underside)];
}

std::uint64_t building_count(const TileView& tile) {
  std::set<std::uint32_t> buildings;
  for (const package::SurfaceRun& run : tile.surface_runs)
    if (tile.surfaces[run.surface].building != package::no_building)
      buildings.insert(tile.building_number(tile.surfaces[run.surface]));
  return buildings.size();
}

std::uint64_t bytes_of(const TileView& tile) {
  std::uint64_t bytes = sizeof(package::CellRecord) + tile.mesh.vertices.size_bytes() + tile.mesh.triangles.size_bytes() +
                        tile.surface_runs.size_bytes() + tile.loose_edges.size_bytes();
  for (const auto& of_role : tile.edge_sides) bytes += of_role.size_bytes();
  return bytes;
}

std::vector<NeighborCell> near_cells_of(const PackageReader& reader, Cell cell) {
  std::vector<NeighborCell> cells;
  const CellRange near = reader.grid().neighborhood_of(cell).intersection(reader.grid().cells);
  for (std::size_t n = 0; n < static_cast<std::size_t>(near.size()); ++n) {
    const Cell c = near.cell_at(n);
    cells.push_back({{c.i, c.j}, reader.tile(c).mesh.triangles.size()});
  }
  return cells;
}

void add_far_map(const PackageReader& reader, Cell cell, CellContents& contents) {
  contents.has_far_map = reader.has_far_map(cell);
  if (!contents.has_far_map) return;
  contents.far_map_bytes = reader.far_map_bytes(cell);
  const BlockTiles& block = reader.block_tiles(cell);
  if (!reader.manifest().far_map.is_box() && block.has_far_cells())
    contents.explicit_edges = block.explicit_occluders(cell, reader.grid().cell_edge_m).explicit_edges.size();
}

/// Gathers the triangles of tiles, building by building.
class PartsOfCity {
 public:
  explicit PartsOfCity(const package::Manifest& manifest) : manifest_(manifest) {}

  void add(const BlockTiles& block, const TileView& tile, Cell cell) {
    numbers_.assign(tile.mesh.vertices.size(), {});
    for (const auto& [building, runs] : runs_by_building(tile)) {
      MeshPart& part = parts_.emplace_back(PlacedPart{building, cell, new_part(block, tile, runs.front(), cell)}).mesh;
      for (const TriangleRun& run : runs)
        for (std::uint32_t t = run.begin; t < run.end; ++t)
          add_triangle(tile, tile.mesh.triangles[t], tile.surfaces[run.surface], part);
    }
  }
  /// The ground comes first.
  [[nodiscard]] std::vector<MeshPart> parts() && {
    std::ranges::sort(parts_, {}, [](const PlacedPart& part) { return std::pair{part.building, part.cell}; });
    std::vector<MeshPart> parts;
    parts.reserve(parts_.size());
    for (PlacedPart& part : parts_) parts.push_back(std::move(part.mesh));
    return parts;
  }

 private:
  /// Triangles of a tile that follow each other, of one surface.
  struct TriangleRun {
    std::uint32_t surface, begin, end;
  };
  struct PlacedPart {
    std::uint64_t building;  ///< 0 for the ground, and the buildings from 1 on
    Cell cell;
    MeshPart mesh;
  };
  /// The number of a tile's vertex in the part that has met it last.
  struct VertexNumber {
    std::size_t part = 0;  ///< counted from 1
    std::uint32_t number = 0;
  };

  static std::map<std::uint64_t, std::vector<TriangleRun>> runs_by_building(const TileView& tile) {
    std::map<std::uint64_t, std::vector<TriangleRun>> runs;
    std::uint32_t begin = 0;
    for (const package::SurfaceRun& run : tile.surface_runs) {
      const package::SurfaceRecord& surface = tile.surfaces[run.surface];
      const bool is_ground = surface.building == package::no_building;
      runs[is_ground ? 0 : std::uint64_t{tile.building_number(surface)} + 1].push_back({run.surface, begin, run.end});
      begin = run.end;
    }
    return runs;
  }

  static MeshPart new_part(const BlockTiles& block, const TileView& tile, const TriangleRun& run, Cell cell) {
    MeshPart part;
    part.cell = {cell.i, cell.j};
    const package::SurfaceRecord& surface = tile.surfaces[run.surface];
    if (surface.building == package::no_building) return part;
    part.building = tile.building_number(surface);
    part.id = std::string(block.id_of(tile.buildings[surface.building]));
    return part;
  }

  std::uint32_t vertex_in(MeshPart& part, const TileView& tile, std::uint32_t vertex) {
    VertexNumber& known = numbers_[vertex];
    if (known.part != parts_.size()) {
      known = {parts_.size(), static_cast<std::uint32_t>(part.vertices_projected.size())};
      const Point3f p = tile.mesh.vertices[vertex];
      const Point2d corner = manifest_.grid.corner_of({part.cell.i, part.cell.j});
      part.vertices_projected.push_back(
          manifest_.projected_from_grid({corner.x + p.x, corner.y + p.y, manifest_.height_origin_m + p.z}));
    }
    return known.number;
  }

  void add_triangle(const TileView& tile, const Triangle& t, const package::SurfaceRecord& surface, MeshPart& part) {
    const Point3f a = tile.mesh.vertices[t.a], b = tile.mesh.vertices[t.b], c = tile.mesh.vertices[t.c];
    MeshTriangle triangle{
        {vertex_in(part, tile, t.a), vertex_in(part, tile, t.b), vertex_in(part, tile, t.c)}, surface.kind(), surface.number};
    // A package makes no promise on the turn of a triangle; its surface has a normal
    if (dot(cross(b - a, c - a), surface.normal().direction()) < 0.0F) std::swap(triangle.vertices[1], triangle.vertices[2]);
    part.triangles.push_back(triangle);
  }

  const package::Manifest& manifest_;
  std::vector<PlacedPart> parts_;
  std::vector<VertexNumber> numbers_;  ///< of the vertices of the tile that is being read
};

PackedCrowns crowns_in(const package::Manifest& manifest) {
  if (!manifest.canopy) return {};
  const auto& [spheroids, cylinders, prisms] = manifest.canopy->crowns_of_shape;
  return {spheroids, cylinders, prisms, manifest.canopy->stamp.bytes};
}

void require_usable(const CellRectangle& cells) {
  constexpr std::int64_t most_cells = 10'000;
  if (cells.i_begin >= cells.i_end || cells.j_begin >= cells.j_end)
    throw InvalidArgument("the rectangle of cells is empty: it is half open, and begins in the south-west");
  const std::int64_t width = std::int64_t{cells.i_end} - cells.i_begin, height = std::int64_t{cells.j_end} - cells.j_begin;
  if (width > most_cells || height > most_cells || width * height > most_cells)
    throw InvalidArgument("the rectangle has more than " + std::to_string(most_cells) + " cells: ask for a part at a time");
}

}  // namespace

std::optional<HeightRange> heights_of(const Package& package) {
  const PackageInUse in_use(package);
  const auto [low, high] = in_use.reader().z_range_m();
  if (!(low <= high)) return std::nullopt;
  const double origin = in_use.reader().manifest().height_origin_m;
  return HeightRange{origin + low, origin + high};
}

PackageInventory inventory_of(const Package& package) {
  const PackageInUse in_use(package);
  const package::Manifest& m = in_use.reader().manifest();
  PackageInventory inventory;
  inventory.format_version = m.version;
  inventory.origin_m = m.origin_m;
  inventory.height_origin_m = m.height_origin_m;
  inventory.cells = rectangle_of(m.grid.cells);
  inventory.block_edge = m.grid.block_edge;
  inventory.blocks = m.blocks.size();
  inventory.assign = m.assign;
  inventory.azimuth_bins = m.far_map.azimuth_bins;
  inventory.squares_per_edge = m.far_map.squares_per_edge;
  inventory.layers = m.far_map.layers;
  inventory.tolerance = m.far_map.tolerance;
  inventory.side_columns = m.far_map.side_columns;
  inventory.rows = m.far_map.rows;
  for (const package::BlockFiles& files : m.blocks) {
    inventory.tile_bytes += files.tiles.bytes;
    inventory.far_map_bytes += files.far_map.bytes;
  }
  inventory.crowns = crowns_in(m);
  for (const package::InputFile& input : m.inputs) inventory.inputs.push_back({input.name, input.stamp.bytes, input.stamp.xxh3});
  inventory.problems = m.problem_counts;
  return inventory;
}

CellContents inspect_cell(const Package& package, CellPlace place) {
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const package::Manifest& m = reader.manifest();
  const Cell cell = existing_cell(m.grid, place);
  const TileView tile = reader.tile(cell);
  CellContents contents;
  contents.cell = place;
  const auto [low, high] = m.grid.square_of(cell);
  for (std::size_t n = 0; const Point2d corner : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}})
    contents.corners_projected[n++] = horizontal(m.projected_from_grid({corner.x, corner.y, 0.0}));
  contents.vertices = tile.mesh.vertices.size();
  contents.triangles = tile.mesh.triangles.size();
  contents.buildings = building_count(tile);
  count_edges(tile, contents);
  if (tile.cell->z_low_m <= tile.cell->z_high_m) {
    contents.low_m = m.height_origin_m + tile.cell->z_low_m;
    contents.high_m = m.height_origin_m + tile.cell->z_high_m;
  }
  contents.tile_bytes = bytes_of(tile);
  add_far_map(reader, cell, contents);
  contents.neighborhood = rectangle_of(m.grid.neighborhood_of(cell));
  contents.near_cells = near_cells_of(reader, cell);
  return contents;
}

std::vector<MeshPart> geometry_of(const Package& package, const CellRectangle& cells) {
  require_usable(cells);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const CellRange range = CellRange{cells.i_begin, cells.j_begin, cells.i_end, cells.j_end}.intersection(reader.grid().cells);
  PartsOfCity parts(reader.manifest());
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) {
    const Cell cell = range.cell_at(n);
    parts.add(reader.block_tiles(cell), reader.tile(cell), cell);
  }
  return std::move(parts).parts();
}

}  // namespace farlod
