// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pack_target.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <memory>
#include <set>
#include <span>
#include <system_error>

#include "base/cancellation.hpp"
#include "base/durable_file.hpp"
#include "base/shard_parts.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/package_folder.hpp"
#include "package/package_writer.hpp"
#include "package/pixel_heights.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

/// What is saved of a tile beside what it has many of.
struct TileRecord {
  std::uint64_t vertices, triangles, edges, triangles_of_readers, edges_of_readers;
  float z_low_m, z_high_m, ground_at_centre_m;
};

/// What the arrays are for this build, and how many tiles there are.
struct Layout {
  std::array<std::uint64_t, 7> element_bytes{sizeof(Point3f),    sizeof(Triangle),     sizeof(HorizonEdge),      sizeof(Surface),
                                             sizeof(TileRecord), sizeof(OccluderEdge), sizeof(CityHorizon::Node)};
  double height_origin_m = 0.0;
  std::uint64_t tile_count = 0, polygon_count = 0, foundation_count = 0, squares_of_readers = 0, has_horizon = 0;
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
      const TileRecord record{
          t.vertices.size(), t.triangles.size(), t.horizon_edges.size(), t.of_readers.triangles, t.of_readers.edges,
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
    t.of_readers = {record.triangles_of_readers, record.edges_of_readers};
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
  city.tiles.squares_of_readers = layout->squares_of_readers;
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
  make_folder(folder);
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
  layout.squares_of_readers = tiles.squares_of_readers;
  layout.has_horizon = horizon != nullptr ? 1 : 0;
  write_durably(folder / layout_file, std::as_bytes(std::span(&layout, 1)));
  write_durably(folder / city_record_file, record);
}

}  // namespace farlod

namespace farlod::pipeline {
namespace {

namespace fs = std::filesystem;

georeference::RequestedArea requested(const FarMapArea& area) {
  if (const auto* file = std::get_if<fs::path>(&area)) return georeference::read_area(*file);
  return {"The area", {{area_of(std::get<Box2d>(area)), {}}}};
}

/// The folder that a name leads to: it is replaced, and a link to it stays. Without a slash behind it.
fs::path folder_of_output(const fs::path& output) {
  std::error_code unread;
  const fs::path named = output.has_filename() ? output : output.parent_path();
  return fs::is_symlink(named, unread) ? fs::weakly_canonical(named, unread) : named;
}

/// The package that is there and is not replaced.
std::optional<ExistingPackage> existing_package(const StageSettings& settings, const fs::path& package,
                                                const PackageOrigin& origin) {
  remove_replaced_packages(package);
  const bool may_be_there =
      settings.overwrite == Overwrite::refuse && (settings.area || settings.resume || was_just_published(package, origin));
  std::optional<ExistingPackage> existing = may_be_there ? ExistingPackage::find(package) : std::nullopt;
  std::error_code unread;
  // It is refused: nobody comes to go on with what a killed run has left beside it
  if (!existing && settings.overwrite == Overwrite::refuse && fs::exists(package / package::manifest_file, unread))
    UnfinishedPackage::remove_useless(package);
  existing ? require_replaceable(package) : require_room(package, settings.overwrite);
  return existing;
}

UnfinishedPackage opened(const StageSettings& settings, const fs::path& package, const PackageOrigin& origin) {
  using OfAnotherOrigin = UnfinishedPackage::OfAnotherOrigin;
  const bool is_shard = settings.part == PackPart::shard;
  return UnfinishedPackage::open(package, origin, is_shard ? LockKind::shared : LockKind::exclusive,
                                 is_shard || settings.resume ? OfAnotherOrigin::refuse : OfAnotherOrigin::replace);
}

/// Bytes of the package's files.
std::uint64_t bytes_of(const fs::path& package, const package::Manifest& manifest) {
  std::error_code unread;
  const std::uintmax_t of_manifest = fs::file_size(package / package::manifest_file, unread);
  std::uint64_t bytes = unread ? 0 : of_manifest;
  for (const package::BlockFiles& b : manifest.blocks) bytes += b.tiles.bytes + b.far_map.bytes;
  if (manifest.canopy) bytes += manifest.canopy->stamp.bytes;
  if (manifest.sources) bytes += manifest.sources->bytes;
  if (manifest.far_terrain) bytes += manifest.far_terrain->bytes;
  if (manifest.heights()) bytes += manifest.heights()->bytes;
  return bytes;
}

/// "shard 3/8: blocks 0_1 0_2; shard 5/8: blocks 1_1"
std::string missing_text(const CityRecord& record, const std::set<std::size_t>& missing, std::size_t shards) {
  std::string text;
  for (std::size_t index = 0; index < shards; ++index) {
    std::string blocks;
    for (const std::size_t n : parts_of_shard(record.costs, {index, shards}))
      if (missing.contains(n)) {
        const Block b = record.plan.blocks[n].block;
        blocks += " " + std::to_string(b.i) + "_" + std::to_string(b.j);
      }
    if (!blocks.empty())
      text += (text.empty() ? "" : "; ") + ("shard " + std::to_string(index) + "/" + std::to_string(shards)) + " (blocks" +
              blocks + ")";
  }
  return text;
}

}  // namespace

void require_folders_above(const fs::path& output) {
  // What cannot be looked at is refused when it is written
  std::error_code unread;
  for (fs::path above = fs::absolute(output, unread).parent_path(); above.has_relative_path(); above = above.parent_path())
    if (fs::exists(above, unread) && !fs::is_directory(above, unread))
      throw OutputError(output.string() + " cannot be written: " + above.string() + ": Not a directory");
}

PackTarget::PackTarget(const StageSettings& settings, const PackageOrigin& origin, const std::stop_token& stop)
    : settings_(&settings),
      package_(folder_of_output(settings.output)),
      existing_(existing_package(settings, package_, origin)),
      unfinished_(opened(settings, package_, origin)) {
  if (settings.area) area_ = requested(*settings.area);
  if (!unfinished_.finding().empty()) notes_.push_back(unfinished_.finding());
  find_saved_city();
  if (settings.part != PackPart::shard) return;
  shard_lock_ = unfinished_.lock_shard(settings.shard.index, settings.shard.count);
  if (saved_city_) return;
  city_lock_ = unfinished_.lock_city(stop);
  find_saved_city();
  if (saved_city_) city_lock_.reset();
}

PackTarget::PackTarget(const StageSettings& settings, UnfinishedPackage unfinished)
    : settings_(&settings), package_(folder_of_output(settings.output)), unfinished_(std::move(unfinished)) {}

void PackTarget::find_saved_city() {
  if (const auto text = SavedCity::find_record(unfinished_.city_folder())) saved_city_ = city_record_from(*text);
}

std::pair<PackTarget, CityRecord> PackTarget::to_merge(const StageSettings& settings,
                                                       const std::optional<PackageOrigin>& origin) {
  const fs::path package = folder_of_output(settings.output);
  auto unfinished = UnfinishedPackage::open_existing(package, LockKind::exclusive);
  if (!unfinished)
    throw OutputError("there is nothing to merge into " + package.string() + ": no shard has made a part of it (--shard).");
  const std::string what = origin ? difference(unfinished->origin(), *origin) : std::string();
  if (!what.empty())
    throw OutputError("the shards of " + package.string() + " are of another package: " + what + ". Give what they were given.");
  PackTarget target(settings, std::move(*unfinished));
  target.existing_ = existing_package(settings, package, target.unfinished_.origin());
  target.find_saved_city();
  if (!target.saved_city_)
    throw OutputError("the shards of " + package.string() + " have not read their city to the end: run them again.");
  CityRecord record = *target.saved_city_;
  std::set<std::size_t> missing;
  for (std::size_t n = 0; n < record.plan.blocks.size(); ++n) {
    const PlannedBlock& b = record.plan.blocks[n];
    if (!b.kept && !target.unfinished_.finished(b.block, b.mapped)) missing.insert(n);
  }
  if (!missing.empty())
    throw OutputError(package.string() + " is not complete: " +
                      missing_text(record, missing, target.unfinished_.shard_count().value_or(1)) + ". Run what is missing.");
  return {std::move(target), std::move(record)};
}

BlockPlan PackTarget::plan(const Georeference& georeference, PackedCity& result) const {
  const package::Manifest& manifest = result.manifest;
  if (existing_) existing_->require_same(manifest, Known::before_tiles);
  if (!area_) {
    BlockPlan plan = plan_all(manifest.grid, existing());
    if (plan.far_maps == 0) result.notes.emplace_back("The package is whole already");
    return plan;
  }
  BlockPlan plan = plan_area(*area_, georeference, manifest.grid, existing());
  if (plan.shapes_outside_of_grid > 0)
    result.notes.push_back("Shapes of the area that meet no cell of the grid: " + std::to_string(plan.shapes_outside_of_grid));
  if (plan.far_maps == 0) result.notes.emplace_back("All cells of the area have far maps already");
  return plan;
}

std::optional<BlockPlan> PackTarget::plan_of_relief(PackedCity& result) const {
  const bool wants_far_maps = area_ || settings_->choice || settings_->far_map.kind == FarMapKind::box;
  if (wants_far_maps || !package::has_rough_surface(result.manifest)) return std::nullopt;
  result.notes.emplace_back(
      "A rough surface: rays march over its pixels, and no far maps are made. Bounds, and what hides the sky near and far, alone "
      "take a tenth of a second a receiver and more, since they come from the whole surface; --area makes far maps for them");
  return plan_none(result.manifest.grid, existing());
}

void PackTarget::require_same_city(const TileSet& tiles, const package::Manifest& manifest) const {
  existing_->require_same(manifest, Known::all);
  existing_->require_same_tiles(tiles, manifest.grid);
}

void PackTarget::save_city(const TileSet& tiles, const CityHorizon* horizon, const CityRecord& record,
                           const std::stop_token& stop) {
  farlod::save_city(unfinished_.city_folder(), tiles, horizon, record.result.manifest.grid, record_text(record), stop);
  city_lock_.reset();
}

void PackTarget::publish(CityRecord& record) {
  const auto require = [this](bool is_as_it_was) {
    if (!is_as_it_was) throw OutputError(unfinished_.package_folder().string() + " was changed while it was made: pack again.");
  };
  package::Manifest& manifest = record.result.manifest;
  const auto is_kept = [](const PlannedBlock& b) { return b.kept.has_value(); };
  const bool is_there = existing_ && std::ranges::all_of(record.plan.blocks, is_kept) && are_others_whole(package_, manifest);
  require(is_there || are_others_whole(unfinished_.package_folder(), manifest));
  manifest.blocks.clear();
  for (const PlannedBlock& b : record.plan.blocks) {
    if (b.kept && !is_there) unfinished_.adopt(package_, *b.kept);
    const auto files = b.kept ? b.kept : unfinished_.finished(b.block, b.mapped);
    require(files.has_value());
    manifest.blocks.push_back(*files);
  }
  if (existing_) existing_->require_unchanged();
  if (!is_there) {
    const std::string note = unfinished_.publish(manifest);
    if (!note.empty()) record.result.notes.push_back(note);
  }
  manifest.file_xxh3 = stamp_of(package_ / package::manifest_file).xxh3;
  record.result.package_bytes = bytes_of(package_, manifest);
}

}  // namespace farlod::pipeline
