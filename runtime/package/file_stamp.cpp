// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/file_stamp.hpp"

#include <sys/stat.h>
#include <xxhash.h>

#include <string>

#include "farlod/error.hpp"
#include "package/manifest_reader.hpp"

namespace farlod {

void check_stamp(const PackageFile& file, std::span<const std::byte> bytes, const package::FileStamp& stamp) {
  if (bytes.size() != stamp.bytes)
    throw PackageDamaged(file.name + " is damaged: it has " + std::to_string(bytes.size()) + " bytes, the manifest says " +
                         std::to_string(stamp.bytes) + ". Copy it again, or pack the city again.");
  if (XXH3_64bits(bytes.data(), bytes.size()) != stamp.xxh3)
    throw PackageDamaged(file.name + " is damaged: its checksum is not the manifest's. Copy it again, or pack the city again.");
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
