// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/file_stamp.hpp"

#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>

#include "farlod/error.hpp"
#include "package/manifest_reader.hpp"

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

}  // namespace farlod
