// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_reader.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/relief_tiles.hpp"

namespace farlod {

namespace {

using package::BlockFiles;

/// The files of a block, each opened when it is first needed. Tiles stay mapped from then on, even while they hold no memory; the
/// reader of far maps goes and comes.
struct OpenBlock {
  std::once_flag tiles_once, far_map_checked;
  std::optional<MappedFile> tiles_bytes;
  std::optional<BlockTiles> tiles;
  std::mutex far_map_mutex;
  std::shared_ptr<const FarMapReader> far_map;
  // What the files were when they were opened; to be read once the flags are set
  FileIdentity tiles_identity, far_map_identity;
  std::atomic<bool> has_tiles = false, has_far_map = false;

  void let_go() {
    if (tiles_bytes) tiles_bytes->let_go();
    const std::lock_guard lock(far_map_mutex);
    far_map.reset();
  }
};

/// A file of the whole city, opened when it is first needed, and mapped from then on.
template <class File>
class OpenOnDemand {
 public:
  /// That of a package whose manifest names it.
  const File& open(const PackageFolder& folder, const package::Manifest& manifest, const char* name) {
    std::call_once(once_, [&] {
      identity_ = identity_of(folder.file(name).path);
      file_.emplace(folder, manifest);
      is_open_ = true;
    });
    return *file_;
  }
  void let_go() const {
    if (is_open_) file_->let_go();
  }
  void require_unchanged(const PackageFolder& folder, const char* name) const {
    if (is_open_) farlod::require_unchanged(folder.file(name), identity_);
  }

 private:
  std::once_flag once_;
  std::optional<File> file_;
  FileIdentity identity_;
  std::atomic<bool> is_open_ = false;
};

}  // namespace

struct PackageReader::Impl {
  std::optional<PackageFolder> folder;  ///< none of a package in memory
  FileIdentity manifest_identity;       // first, so that a manifest that is replaced meanwhile is noticed
  package::Manifest manifest;
  std::vector<OpenBlock> blocks;
  OpenOnDemand<CrownsFile> open_crowns;
  OpenOnDemand<FarTerrainFile> open_far_terrain;
  OpenOnDemand<PixelHeightsFile> open_heights;
  std::once_flag relief_once;
  std::optional<ReliefTiles> relief;  ///< once a tile of a rough surface is asked for, some of which is in no tiles file
  std::mutex held_mutex;
  LruCache held;

  std::optional<PackageInMemory> memory;

  explicit Impl(const std::filesystem::path& name)
      : folder(name),
        manifest_identity(identity_of(folder->file(package::manifest_file).path)),
        manifest(read_manifest(*folder)),
        blocks(manifest.blocks.size()) {}
  explicit Impl(PackageInMemory contents)
      : manifest(std::move(contents.manifest)), blocks(manifest.blocks.size()), memory(std::move(contents)) {
    FARLOD_EXPECTS(memory->tiles.size() == blocks.size());
  }

  std::size_t index_of(Cell cell) const {
    FARLOD_EXPECTS(manifest.grid.cells.contains(cell));
    const Block wanted = manifest.grid.block_of(cell);
    const auto south_west_first = [](const BlockFiles& a, const Block& b) {
      return std::pair(a.block.j, a.block.i) < std::pair(b.j, b.i);
    };
    const auto found = std::lower_bound(manifest.blocks.begin(), manifest.blocks.end(), wanted, south_west_first);
    FARLOD_EXPECTS(found != manifest.blocks.end() && found->block == wanted);
    return static_cast<std::size_t>(found - manifest.blocks.begin());
  }

  std::filesystem::path name_of(std::size_t n, const char* file) const {
    return std::filesystem::path(package::folder_of(manifest.blocks[n])) / file;
  }
  PackageFile file_of(std::size_t n, const char* file) const { return folder->file(name_of(n, file)); }
  /// A package in memory has it, too, though its files have names alone.
  std::string shown_name_of(std::size_t n, const char* file) const {
    return folder ? file_of(n, file).name : name_of(n, file).string();
  }

  /// What a block holds at the most: its tiles, read from end to end, and where in its file the far map of each cell lies.
  std::uint64_t bytes_of(std::size_t n) const {
    constexpr std::uint64_t bytes_of_place = 8;
    const BlockFiles& files = manifest.blocks[n];
    return files.tiles.bytes + bytes_of_place * static_cast<std::uint64_t>(manifest.grid.cells_of(files.block).size());
  }

  /// A block that is open is being used; others may have to go.
  void use(std::size_t n) {
    const std::lock_guard lock(held_mutex);
    const std::vector<std::size_t> others = held.use(n, bytes_of(n));
    for (const std::size_t other : others) blocks[other].let_go();
    // Those around the blocks that are left come back
    if (!others.empty()) open_crowns.let_go();
  }

  const BlockTiles& tiles(std::size_t n) {
    OpenBlock& open = blocks[n];
    std::call_once(open.tiles_once, [&] {
      const CellRange cells = manifest.grid.cells_of(manifest.blocks[n].block);
      if (memory) {
        open.tiles.emplace(memory->tiles[n], cells, shown_name_of(n, package::tiles_file));
        return;
      }
      const PackageFile file = folder->plain_file(name_of(n, package::tiles_file));
      open.tiles_identity = identity_of(file.path);
      open.tiles_bytes.emplace(file);
      check_stamp(file, open.tiles_bytes->bytes(), manifest.blocks[n].tiles);
      open.tiles.emplace(open.tiles_bytes->bytes(), cells, file.name);
      open.has_tiles = true;
    });
    if (!memory) use(n);
    return *open.tiles;
  }

  TileView tile(Cell cell) {
    TileView stored = tiles(index_of(cell)).tile(cell);
    if (memory || !manifest.pixels || !manifest.pixels->squares) return stored;
    std::call_once(relief_once, [&] { relief.emplace(*pixel_heights(), *manifest.pixels, manifest.grid); });
    return relief->whole(stored, cell);
  }

  /// Whoever has the reader keeps it, even when the block has to go meanwhile. The block's tiles must be open.
  std::shared_ptr<const FarMapReader> far_maps(std::size_t n) {
    OpenBlock& open = blocks[n];
    const PackageFile file = file_of(n, package::far_map_file);
    std::call_once(open.far_map_checked, [&] {
      (void)folder->plain_file(name_of(n, package::far_map_file));
      open.far_map_identity = identity_of(file.path);
      check_stamp(file, MappedFile(file).bytes(), manifest.blocks[n].far_map);
      open.has_far_map = true;
    });
    const std::lock_guard lock(open.far_map_mutex);
    if (!open.far_map)
      open.far_map = std::make_shared<const FarMapReader>(file, manifest.grid.cells_of(manifest.blocks[n].block),
                                                          manifest.far_map, manifest.blocks[n].mapped);
    return open.far_map;
  }

  MeshView far_terrain() {
    if (memory) return memory->far_terrain;
    return manifest.far_terrain ? open_far_terrain.open(*folder, manifest, package::far_terrain_file).mesh() : MeshView{};
  }

  const PixelHeightsFile* pixel_heights() {
    if (memory || !manifest.heights()) return nullptr;
    return &open_heights.open(*folder, manifest, package::heights_file);
  }

  void require_unchanged() const {
    if (memory) return;
    farlod::require_unchanged(folder->file(package::manifest_file), manifest_identity);
    open_crowns.require_unchanged(*folder, package::crowns_file);
    open_far_terrain.require_unchanged(*folder, package::far_terrain_file);
    open_heights.require_unchanged(*folder, package::heights_file);
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      if (blocks[n].has_tiles) farlod::require_unchanged(file_of(n, package::tiles_file), blocks[n].tiles_identity);
      if (blocks[n].has_far_map) farlod::require_unchanged(file_of(n, package::far_map_file), blocks[n].far_map_identity);
    }
  }
};

PackageReader::PackageReader(const std::filesystem::path& folder) : impl_(std::make_unique<Impl>(folder)) {}
PackageReader::PackageReader(PackageInMemory contents) : impl_(std::make_unique<Impl>(std::move(contents))) {}
PackageReader::PackageReader(PackageReader&&) noexcept = default;
PackageReader& PackageReader::operator=(PackageReader&&) noexcept = default;
PackageReader::~PackageReader() = default;

const PackageFolder& PackageReader::folder() const {
  FARLOD_EXPECTS(impl_->folder.has_value());
  return *impl_->folder;
}

const package::Manifest& PackageReader::manifest() const { return impl_->manifest; }

const package::BlockFiles& PackageReader::files_of(Cell cell) const { return impl_->manifest.blocks[impl_->index_of(cell)]; }

const BlockTiles& PackageReader::block_tiles(Cell cell) const { return impl_->tiles(impl_->index_of(cell)); }

TileView PackageReader::tile(Cell cell) const { return impl_->tile(cell); }

std::pair<float, float> PackageReader::z_range_m() const {
  auto [low, high] = std::pair(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());
  const auto add = [&low = low, &high = high](std::span<const std::byte> bytes, const std::string& name) {
    const std::span<const package::CellRecord> cells = BlockTiles::records_of_cells(bytes, name);
    for (const package::CellRecord& cell : cells) {
      if (!(cell.z_low_m <= cell.z_high_m)) continue;
      low = std::min(low, cell.z_low_m);
      high = std::max(high, cell.z_high_m);
    }
  };
  if (const auto& pixels = manifest().pixels; !impl_->memory && pixels && pixels->squares) {
    for (const float height_m : pixel_heights()->height_m()) {
      if (!std::isnan(height_m)) low = std::min(low, height_m), high = std::max(high, height_m);
    }
    pixel_heights()->let_go();
  }
  for (std::size_t n = 0; n < impl_->blocks.size(); ++n) {
    const std::string shown = impl_->shown_name_of(n, package::tiles_file);
    if (impl_->memory)
      add(impl_->memory->tiles[n], shown);
    else
      add(MappedFile(impl_->folder->plain_file(impl_->name_of(n, package::tiles_file))).bytes(), shown);
  }
  return {low, high};
}

bool PackageReader::has_far_map(Cell cell) const {
  const BlockFiles& files = impl_->manifest.blocks[impl_->index_of(cell)];
  return files.has_far_map(impl_->manifest.grid.cells_of(files.block).index_of(cell));
}

BoxFarMap PackageReader::box_far_map(Cell cell) const {
  FARLOD_EXPECTS(!impl_->memory && has_far_map(cell));
  const std::size_t n = impl_->index_of(cell);
  const float top = impl_->tiles(n).tile(cell).cell->far_map_top;
  return impl_->far_maps(n)->read_box(cell, top);
}

FarHorizon PackageReader::far_horizon(Cell cell) const {
  FARLOD_EXPECTS(has_far_map(cell));
  if (impl_->memory) return impl_->memory->far_horizons.at(cell);
  const std::size_t n = impl_->index_of(cell);
  const package::FarMapShape& shape = impl_->manifest.far_map;
  const BlockTiles& tiles = impl_->tiles(n);
  if (!tiles.has_far_cells())
    throw PackageDamaged(impl_->shown_name_of(n, package::tiles_file) +
                         " is damaged: it does not name what its far maps need. Pack the city again.");
  const double cell_edge_m = grid().cell_edge_m;
  FarHorizon map{ReceiverPatches(cell_edge_m, shape.squares_per_edge, tiles.levels_m(cell, shape.layers)),
                 AzimuthBins{shape.azimuth_bins},
                 {},
                 {},
                 {},
                 {},
                 tiles.explicit_occluders(cell, cell_edge_m)};
  impl_->far_maps(n)->read_slopes(cell, map);
  return map;
}

std::uint64_t PackageReader::far_map_bytes(Cell cell) const {
  FARLOD_EXPECTS(!impl_->memory && has_far_map(cell));
  return impl_->far_maps(impl_->index_of(cell))->stored_bytes(cell);
}

bool PackageReader::has_crowns() const { return !impl_->memory && impl_->manifest.canopy; }

const CrownsFile& PackageReader::crowns() const {
  FARLOD_EXPECTS(has_crowns());
  return impl_->open_crowns.open(*impl_->folder, impl_->manifest, package::crowns_file);
}

MeshView PackageReader::far_terrain() const { return impl_->far_terrain(); }

const PixelHeightsFile* PackageReader::pixel_heights() const { return impl_->pixel_heights(); }

std::span<const Crown> PackageReader::crowns_of(Cell cell) const {
  FARLOD_EXPECTS(grid().cells.contains(cell));
  return has_crowns() ? crowns().crowns_of(cell) : std::span<const Crown>{};
}

void PackageReader::require_unchanged() const { impl_->require_unchanged(); }

void PackageReader::hold_at_most(std::uint64_t bytes) {
  const std::lock_guard lock(impl_->held_mutex);
  impl_->held.keep_at_most(bytes);
}

}  // namespace farlod
