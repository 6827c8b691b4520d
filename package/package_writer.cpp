// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_writer.hpp"

#include <sys/stat.h>

#include <regex>
#include <span>
#include <stdexcept>
#include <system_error>
#include <variant>
#include <vector>

#include "base/durable_file.hpp"
#include "base/file_lock.hpp"
#include "base/folder_swap.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/package_folder.hpp"
#include "package/tiles_writer.hpp"

namespace farlod {
namespace fs = std::filesystem;
namespace {

constexpr const char* replaced_ending = ".replaced-";

/// Whether a path within a package's folder is that of something that packages consist of, in any version.
bool is_of_packages(const fs::path& within) {
  static const std::regex known(
      R"((manifest\.json|crowns\.bin|sources\.bin|far_terrain\.bin|heights\.bin|blocks|blocks/-?[0-9]+_-?[0-9]+(_[0-9]+)?(/(tiles\.bin|far\.exr))?)(\.part)?)");
  return std::regex_match(within.generic_string(), known);
}

/// Only what a package consists of may be swept away: a mistyped -o must not cost anybody their files.
void require_package_or_empty(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path within = entry.path().lexically_relative(folder);
    if (!is_of_packages(within))
      throw OutputError(folder.string() + " holds " + within.string() +
                        ", which is not part of a package: choose another folder for -o.");
  }
}

/// A disk that is mounted there keeps its name.
bool is_mount_point(const fs::path& folder) {
  struct stat own {
  }, above{};
  return stat(folder.c_str(), &own) == 0 && stat((folder / "..").c_str(), &above) == 0 && own.st_dev != above.st_dev;
}

/// Nobody reads it, or nobody can.
std::optional<FileLock> locked_for_removal(const fs::path& package) {
  return FileLock::try_lock_existing(package / package::manifest_file, LockKind::exclusive);
}

/// With the manifest first, so that a half-swept package is none.
void sweep(const fs::path& package) {
  std::error_code ignored;
  fs::remove(package / package::manifest_file, ignored);
  fs::remove_all(package, ignored);
}

fs::path free_name_beside(const fs::path& package) {
  for (int n = 1;; ++n)
    if (fs::path name = package.string() + replaced_ending + std::to_string(n); !fs::exists(name)) return name;
}

}  // namespace

void require_replaceable(const fs::path& folder) {
  try {
    if (!fs::exists(folder)) return;
    if (!fs::is_directory(folder)) throw OutputError(folder.string() + " is a file: choose another name for -o.");
    require_package_or_empty(folder);
    if (is_mount_point(folder))
      throw OutputError(folder.string() + " is the root of a disk, which cannot be replaced: name a folder in it for -o.");
  } catch (const fs::filesystem_error& reason) {
    throw OutputError(folder.string() + " cannot be written: " + reason.code().message());
  }
}

void require_room(const fs::path& folder, Overwrite overwrite) {
  require_replaceable(folder);
  // What has blocks and no manifest was never finished
  std::error_code unread;
  if (overwrite == Overwrite::refuse && fs::exists(folder / package::manifest_file, unread))
    throw OutputError(folder.string() + " exists already: let it be replaced (--force), or choose another folder.");
}

void put_in_place(const fs::path& finished, const fs::path& package, const fs::path& aside) {
  std::error_code unread;
  fs::exists(package, unread) ? swap_folders(finished, package, aside) : move_folder(finished, package);
}

void move_package(const fs::path& from, const fs::path& to) { move_folder(from, to); }

std::string dispose_of_package(const fs::path& old, const fs::path& package) {
  std::error_code unread;
  if (!fs::exists(old, unread)) return {};
  if (!fs::exists(old / package::manifest_file, unread) || locked_for_removal(old)) {
    sweep(old);
    return {};
  }
  const fs::path kept = free_name_beside(package);
  move_folder(old, kept);
  return "The package that was replaced is still being read: it is kept as " + kept.string() +
         " until a later run of farlod-pack finds that nobody reads it.";
}

void remove_replaced_packages(const fs::path& package) {
  const std::string prefix = package.filename().string() + replaced_ending;
  const fs::path folder = package.has_parent_path() ? package.parent_path() : ".";
  std::error_code unread;
  std::vector<fs::path> kept;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unread)) {
    const std::string name = entry.path().filename().string();
    const bool ends_in_digits = name.size() > prefix.size() && name.find_first_not_of("0123456789", prefix.size()) == name.npos;
    if (name.starts_with(prefix) && ends_in_digits && entry.is_directory(unread)) kept.push_back(entry.path());
  }
  for (const fs::path& old : kept)
    if (!fs::exists(old / package::manifest_file, unread) || locked_for_removal(old)) sweep(old);
}

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
