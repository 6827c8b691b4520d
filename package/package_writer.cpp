// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_writer.hpp"

#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "base/durable_file.hpp"
#include "farlod/error.hpp"
#include "package/far_map_writer.hpp"
#include "package/layout.hpp"
#include "package/manifest_writer.hpp"
#include "package/package_files.hpp"
#include "package/tiles_writer.hpp"
#include "package/written_stamp.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

/// What far maps of the kind `horizon` add to the tiles file.
std::uint64_t explicit_occluder_bytes(const BakedBlock& maps) {
  const auto* horizons = std::get_if<BakedHorizons>(&maps);
  if (horizons == nullptr) return 0;
  std::uint64_t bytes = horizons->edges.size() * sizeof(HorizonEdge);
  for (const BakedHorizon& cell : horizons->cells)
    bytes += sizeof(package::FarCellRecord) + cell.explicit_edges.size() * sizeof(package::ExplicitOccluder);
  return bytes;
}

package::FileStamp write_tiles(const fs::path& path, std::span<const std::byte> bytes) {
  write_durably(path, bytes);
  return stamp_of(bytes);
}

}  // namespace

package::BlockFiles PackageWriter::write_block(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                               const package::FarMapShape& shape,
                                               const std::optional<package::CellRuns>& mapped) {
  package::BlockFiles files{block, {}, {}, mapped};
  const fs::path folder = folder_ / package::folder_of(files);
  make_folder(folder);
  if (!files.has_far_maps()) {
    files.tiles = write_tiles(folder / package::tiles_file, tiles_file_without_maps(tiles, grid, block));
    return files;
  }
  files.tiles = write_tiles(folder / package::tiles_file, tiles_file(tiles, maps, grid, block, mapped));
  write_durably(folder / package::far_map_file, [&](const fs::path& part) {
    try {
      write_far_maps(part, maps, grid.cells_of(block), shape, mapped);
    } catch (const std::runtime_error& reason) {
      throw OutputError(std::string(reason.what()) + " Is the disk full?");
    }
    files.far_map = stamp_of(part);
  });
  far_map_bytes_ += files.far_map.bytes + explicit_occluder_bytes(maps);
  return files;
}

void PackageWriter::write_manifest(const package::Manifest& manifest) {
  write_durably(folder_ / package::manifest_file, manifest_text(manifest));
}

}  // namespace farlod
