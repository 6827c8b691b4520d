// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "package/package_writer.hpp"

#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contract/package/layout.hpp"
#include "package/far_map_writer.hpp"
#include "package/file_stamp.hpp"
#include "package/manifest_writer.hpp"
#include "package/tiles_writer.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

constexpr const char* blocks_folder = "blocks";

/// Only what a package consists of may be swept away: a mistyped -o must not cost anybody their files.
void require_package_or_empty(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name != package::manifest_file && name != blocks_folder)
      throw OutputError(folder.string() + " holds " + name.string() +
                        ", which is not part of a package: choose another folder for -o.");
  }
}

/// Whether a folder has the name of a block's (package::folder_of), of whatever block.
bool is_block_folder(const std::string& name) {
  static const std::regex of_block("-?[0-9]+_-?[0-9]+(_[0-9]+)?");
  return std::regex_match(name, of_block);
}

/// What far maps of the kind `horizon` add to the tiles file.
std::uint64_t explicit_occluder_bytes(const BakedBlock& maps) {
  const auto* horizons = std::get_if<BakedHorizons>(&maps);
  if (horizons == nullptr) return 0;
  std::uint64_t bytes = horizons->edges.size() * sizeof(HorizonEdge);
  for (const BakedHorizon& cell : horizons->cells)
    bytes += sizeof(package::FarCellRecord) + cell.explicit_edges.size() * sizeof(package::ExplicitOccluder);
  return bytes;
}

fs::path temporary_name(const fs::path& path) { return path.string() + ".part"; }

/// Looks into a folder, makes, moves or removes something; what the file system refuses is told as OutputError.
template <class Work>
void on_disk(const fs::path& path, const Work& work) {
  try {
    work();
  } catch (const fs::filesystem_error& reason) {
    throw OutputError(path.string() + " cannot be written: " + reason.code().message());
  }
}

}  // namespace

void require_room(const fs::path& folder, Overwrite overwrite) {
  on_disk(folder, [&] {
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder)) throw OutputError(folder.string() + " is a file: choose another name for -o.");
    require_package_or_empty(folder);
    if (overwrite == Overwrite::refuse && !fs::is_empty(folder))
      throw OutputError(folder.string() + " exists already: let it be replaced (--force), or choose another folder.");
  });
}

PackageWriter::PackageWriter(fs::path folder, Overwrite overwrite) : folder_(std::move(folder)) {
  require_room(folder_, overwrite);
  on_disk(folder_, [&] {
    fs::remove(folder_ / package::manifest_file);  // first, so that a half-swept package is none
    fs::remove_all(folder_ / blocks_folder);
    fs::create_directories(folder_ / blocks_folder);
  });
}

package::FileStamp PackageWriter::write_file(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path part = temporary_name(path);
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
  on_disk(path, [&] { fs::rename(part, path); });
  bytes_written_ += bytes.size();
  return stamp_of(bytes);
}

PackageWriter::~PackageWriter() {
  std::error_code ignored;
  for (const fs::path& folder : added_) fs::remove_all(folder, ignored);
}

package::BlockFiles PackageWriter::write_block(const TileSet& tiles, const BakedBlock& maps, const Grid& grid, Block block,
                                               const package::FarMapShape& shape,
                                               const std::optional<package::CellRuns>& mapped) {
  package::BlockFiles files{block, {}, {}, mapped};
  const fs::path folder = folder_ / package::folder_of(files);
  on_disk(folder, [&] { fs::create_directories(folder); });
  if (adds_) {
    const std::lock_guard lock(mutex_);
    added_.push_back(folder);
  }
  if (!files.has_far_maps()) {
    files.tiles = write_file(folder / package::tiles_file, tiles_file_without_maps(tiles, grid, block));
    return files;
  }
  files.tiles = write_file(folder / package::tiles_file, tiles_file(tiles, maps, grid, block, mapped));
  const fs::path far = folder / package::far_map_file;
  const fs::path part = temporary_name(far);
  try {
    write_far_maps(part, maps, grid.cells_of(block), shape, mapped);
  } catch (const std::runtime_error& reason) {
    throw OutputError(std::string(reason.what()) + " Is the disk full?");
  }
  files.far_map = stamp_of(part);
  on_disk(far, [&] { fs::rename(part, far); });
  bytes_written_ += files.far_map.bytes;
  far_map_bytes_ += files.far_map.bytes + explicit_occluder_bytes(maps);
  return files;
}

void PackageWriter::finish(const package::Manifest& manifest) {
  const std::string text = manifest_text(manifest);
  write_file(folder_ / package::manifest_file, std::as_bytes(std::span(text)));
  added_.clear();
  if (adds_) remove_all_but(manifest);
}

void PackageWriter::remove_all_but(const package::Manifest& manifest) const {
  std::set<fs::path> named;
  for (const package::BlockFiles& files : manifest.blocks) named.insert(folder_ / package::folder_of(files));
  // The package is whole by now: what cannot be removed does no harm, and the next run tries again
  std::error_code ignored;
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / blocks_folder, ignored))
    if (!named.contains(entry.path()) && is_block_folder(entry.path().filename().string())) others.push_back(entry.path());
  for (const fs::path& other : others) fs::remove_all(other, ignored);
}

}  // namespace farlod
