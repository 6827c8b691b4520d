// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/file_stamp.hpp"

#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "farlod/error.hpp"
#include "package/crown.hpp"
#include "package/layout.hpp"
#include "package/sources_layout.hpp"

namespace farlod {

namespace {

void require_length(const PackageFile& file, std::size_t bytes, const package::FileStamp& stamp) {
  if (bytes != stamp.bytes)
    throw PackageDamaged(file.name + " is damaged: it has " + std::to_string(bytes) + " bytes, the manifest says " +
                         std::to_string(stamp.bytes) + ". Copy it again, or pack the city again.");
}

void require_checksum(const PackageFile& file, XXH64_hash_t xxh3, const package::FileStamp& stamp) {
  if (xxh3 != stamp.xxh3)
    throw PackageDamaged(file.name + " is damaged: its checksum is not the manifest's. Copy it again, or pack the city again.");
}

}  // namespace

void check_stamp(const PackageFile& file, std::span<const std::byte> bytes, const package::FileStamp& stamp) {
  require_length(file, bytes.size(), stamp);
  require_checksum(file, XXH3_64bits(bytes.data(), bytes.size()), stamp);
}

void check_stamp(const PackageFile& file, const MappedFile& mapped, const package::FileStamp& stamp) {
  constexpr std::size_t at_a_time = std::size_t{16} << 20;
  std::span<const std::byte> left = mapped.bytes();
  require_length(file, left.size(), stamp);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  if (!state) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  while (!left.empty()) {
    const std::span<const std::byte> piece = left.first(std::min(at_a_time, left.size()));
    XXH3_64bits_update(state.get(), piece.data(), piece.size());
    mapped.let_go();
    left = left.subspan(piece.size());
  }
  require_checksum(file, XXH3_64bits_digest(state.get()), stamp);
}

std::uint64_t checksum_of_manifest(std::string_view sealed) { return XXH3_64bits(sealed.data(), sealed.size()); }

FileIdentity identity_of(const std::filesystem::path& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  return {static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino),
          static_cast<std::uint64_t>(found.st_size), found.st_mtim.tv_sec * ns_per_s + found.st_mtim.tv_nsec};
}

void require_unchanged(const PackageFile& file, const FileIdentity& opened) {
  if (identity_of(file.path) != opened)
    throw PackageDamaged(file.name + " was written, replaced or removed while the package was open: open the package again.");
}

package::FileStamp stamp_of(std::span<const std::byte> bytes) { return {bytes.size(), XXH3_64bits(bytes.data(), bytes.size())}; }

package::FileStamp stamp_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  package::FileStamp stamp;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    XXH3_64bits_update(state.get(), buffer.data(), static_cast<std::size_t>(file.gcount()));
    stamp.bytes += static_cast<std::uint64_t>(file.gcount());
  }
  if (!file.eof()) throw InputError(path.string() + " cannot be read");
  stamp.xxh3 = XXH3_64bits_digest(state.get());
  return stamp;
}

namespace {

bool is_whole(const std::filesystem::path& path, const package::FileStamp& stamp) {
  std::error_code unread;
  if (!std::filesystem::is_regular_file(path, unread) || std::filesystem::file_size(path, unread) != stamp.bytes) return false;
  try {
    return stamp_of(path) == stamp;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool are_whole(const std::filesystem::path& package, const package::BlockFiles& files) {
  const std::filesystem::path folder = package / package::folder_of(files);
  return is_whole(folder / package::tiles_file, files.tiles) &&
         (!files.has_far_maps() || is_whole(folder / package::far_map_file, files.far_map));
}

bool are_others_whole(const std::filesystem::path& package, const package::Manifest& manifest) {
  return (!manifest.canopy || is_whole(package / package::crowns_file, manifest.canopy->stamp)) &&
         (!manifest.sources || is_whole(package / package::sources_file, *manifest.sources)) &&
         (!manifest.far_terrain || is_whole(package / package::far_terrain_file, *manifest.far_terrain)) &&
         (!manifest.heights() || is_whole(package / package::heights_file, *manifest.heights()));
}

}  // namespace farlod
