// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/saved_city.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <memory>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/durable_file.hpp"
#include "farlod/error.hpp"
#include "package/package_files.hpp"
#include "package/unfinished_package.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

/// What is saved of a tile beside what it has many of.
struct TileRecord {
  std::uint64_t vertices, triangles, edges;
  float z_low_m, z_high_m, ground_at_centre_m;
};

/// What the arrays are for this build, and how many tiles there are.
struct Layout {
  std::array<std::uint64_t, 7> element_bytes{sizeof(Point3f),    sizeof(Triangle),     sizeof(HorizonEdge),      sizeof(Surface),
                                             sizeof(TileRecord), sizeof(OccluderEdge), sizeof(CityHorizon::Node)};
  double height_origin_m = 0.0;
  std::uint64_t tile_count = 0, polygon_count = 0, foundation_count = 0, has_horizon = 0;
};

constexpr const char *layout_file = "layout", *tile_records_file = "tiles", *vertices_file = "vertices",
                     *triangles_file = "triangles", *triangle_surfaces_file = "triangle_surfaces", *edges_file = "edges",
                     *surfaces_file = "surfaces", *building_ids_file = "building_ids", *occluders_file = "occluders",
                     *nodes_file = "nodes";

/// Writes elements one after the other. What lies on disk of them is let go by the caller.
class ArrayFile {
 public:
  explicit ArrayFile(const fs::path& path) : path_(path), file_(path, std::ios::binary | std::ios::trunc) {}

  template <class T>
  void append(std::span<const T> elements) {
    file_.write(reinterpret_cast<const char*>(elements.data()), static_cast<std::streamsize>(elements.size_bytes()));
    if (!file_) refuse();
  }
  void close() {
    file_.close();
    if (!file_) refuse();
  }

 private:
  [[noreturn]] void refuse() const {
    throw OutputError(path_.string() + " cannot be written: " + std::generic_category().message(errno));
  }
  fs::path path_;
  std::ofstream file_;
};

template <class T>
void write_array(const fs::path& path, std::span<const T> elements) {
  ArrayFile file(path);
  file.append(elements);
  file.close();
}

/// In the order in which blocks use them.
template <class Visit>
void for_each_tile_by_block(const Grid& grid, const Visit& visit) {
  for (const Block block : grid.blocks()) {
    const CellRange cells = grid.cells_of(block);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) visit(cells.cell_at(n));
  }
}

void save_tiles(const fs::path& folder, const TileSet& tiles, const Grid& grid, const std::stop_token& stop) {
  ArrayFile records(folder / tile_records_file), vertices(folder / vertices_file), triangles(folder / triangles_file),
      surfaces(folder / triangle_surfaces_file), edges(folder / edges_file);
  for (const Block block : grid.blocks()) {
    throw_if_cancelled(stop);
    const CellRange cells = grid.cells_of(block);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
      const Tile& t = tiles.tile(cells.cell_at(n));
      const TileRecord record{t.vertices.size(), t.triangles.size(), t.horizon_edges.size(),
                              t.z_low_m,         t.z_high_m,         t.ground_at_centre_m};
      records.append(std::span(&record, 1));
      vertices.append(std::span<const Point3f>(t.vertices));
      triangles.append(std::span<const Triangle>(t.triangles));
      surfaces.append(std::span<const std::uint32_t>(t.triangle_surfaces));
      edges.append(std::span<const HorizonEdge>(t.horizon_edges));
    }
    tiles.let_go(cells);
  }
  for (ArrayFile* file : {&records, &vertices, &triangles, &surfaces, &edges}) file->close();
}

/// One after the other, each with a zero behind it: no id has one.
void save_building_ids(const fs::path& path, const std::vector<std::string>& ids) {
  ArrayFile file(path);
  for (const std::string& id : ids) file.append(std::span(id.c_str(), id.size() + 1));
  file.close();
}

std::vector<std::string> building_ids_from(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::string> ids;
  for (std::string id; std::getline(file, id, '\0');) ids.push_back(std::move(id));
  return ids;
}

std::optional<Layout> layout_from(const fs::path& path) {
  Layout layout;
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(&layout), sizeof(layout))) return std::nullopt;
  return layout.element_bytes == Layout{}.element_bytes ? std::optional(layout) : std::nullopt;
}

/// The next so many elements of an array.
template <class T>
TileArray<T> next_of(const PagedArray<T>& all, std::uint64_t count, std::uint64_t& begin) {
  return TileArray<T>::view_of({all.data() + std::exchange(begin, begin + count), count});
}

void view_tiles(const fs::path& folder, const Grid& grid, TileSet& tiles) {
  auto pages = std::make_shared<TilePages>();
  pages->vertices = PagedArray<Point3f>::of_file(folder / vertices_file);
  pages->triangles = PagedArray<Triangle>::of_file(folder / triangles_file);
  pages->triangle_surfaces = PagedArray<std::uint32_t>::of_file(folder / triangle_surfaces_file);
  pages->horizon_edges = PagedArray<HorizonEdge>::of_file(folder / edges_file);
  const auto records = PagedArray<TileRecord>::of_file(folder / tile_records_file);
  std::uint64_t tile = 0, vertex = 0, triangle = 0, triangle_surface = 0, edge = 0;
  for_each_tile_by_block(grid, [&](Cell cell) {
    const TileRecord& record = records[tile++];
    Tile& t = tiles.tile(cell);
    t.vertices = next_of(pages->vertices, record.vertices, vertex);
    t.triangles = next_of(pages->triangles, record.triangles, triangle);
    t.triangle_surfaces = next_of(pages->triangle_surfaces, record.triangles, triangle_surface);
    t.horizon_edges = next_of(pages->horizon_edges, record.edges, edge);
    t.z_low_m = record.z_low_m;
    t.z_high_m = record.z_high_m;
    t.ground_at_centre_m = record.ground_at_centre_m;
  });
  tiles.pages = std::move(pages);
}

}  // namespace

std::optional<std::string> SavedCity::find_record(const fs::path& folder) {
  std::error_code unread;
  if (!fs::exists(folder / city_record_file, unread) || !layout_from(folder / layout_file)) return std::nullopt;
  return text_of(folder / city_record_file);
}

std::optional<SavedCity> SavedCity::open(const fs::path& folder, const Grid& grid) {
  std::optional<std::string> record = find_record(folder);
  const std::optional<Layout> layout = layout_from(folder / layout_file);
  if (!record || !layout || layout->tile_count != static_cast<std::uint64_t>(grid.cells.size())) return std::nullopt;
  SavedCity city{{}, {}, std::move(*record)};
  city.tiles.height_origin_m = layout->height_origin_m;
  city.tiles.polygon_count = layout->polygon_count;
  city.tiles.foundation_count = layout->foundation_count;
  city.tiles.cells = grid.cells;
  city.tiles.tiles.resize(layout->tile_count);
  city.tiles.surfaces = PagedArray<Surface>::of_file(folder / surfaces_file);
  city.tiles.building_ids = building_ids_from(folder / building_ids_file);
  view_tiles(folder, grid, city.tiles);
  if (layout->has_horizon != 0)
    city.horizon.emplace(grid, PagedArray<OccluderEdge>::of_file(folder / occluders_file),
                         PagedArray<CityHorizon::Node>::of_file(folder / nodes_file));
  return city;
}

void save_city(const fs::path& folder, const TileSet& tiles, const CityHorizon* horizon, const Grid& grid,
               const std::string& record, const std::stop_token& stop) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + " cannot be made: " + error.message());
  save_tiles(folder, tiles, grid, stop);
  write_array(folder / surfaces_file, std::span<const Surface>(tiles.surfaces));
  save_building_ids(folder / building_ids_file, tiles.building_ids);
  if (horizon != nullptr) {
    write_array(folder / occluders_file, horizon->occluders());
    write_array(folder / nodes_file, horizon->nodes());
    horizon->let_go();
  }
  Layout layout;
  layout.height_origin_m = tiles.height_origin_m;
  layout.tile_count = tiles.tiles.size();
  layout.polygon_count = tiles.polygon_count;
  layout.foundation_count = tiles.foundation_count;
  layout.has_horizon = horizon != nullptr ? 1 : 0;
  write_durably(folder / layout_file, std::as_bytes(std::span(&layout, 1)));
  write_durably(folder / city_record_file, record);
}

}  // namespace farlod
