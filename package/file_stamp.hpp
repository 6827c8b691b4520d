// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "package/manifest.hpp"
#include "package/mapped_file.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// Throws PackageDamaged when a file is not the one that the manifest names.
void check_stamp(const PackageFile& file, std::span<const std::byte> bytes, const package::FileStamp& stamp);

/// The same of a mapped file, of which some MiB are in memory at a time, and none afterwards.
void check_stamp(const PackageFile& file, const MappedFile& mapped, const package::FileStamp& stamp);

/// What tells a file that was written again, or replaced, from what it was.
struct FileIdentity {
  std::uint64_t device = 0, number = 0, bytes = 0;
  std::int64_t changed_ns = 0;
  bool operator==(const FileIdentity&) const = default;
};

/// Of a file as it is now; all zero where there is none.
[[nodiscard]] FileIdentity identity_of(const std::filesystem::path& path);

/// Throws PackageDamaged where a file of an open package is not what it was when it was opened.
void require_unchanged(const PackageFile& file, const FileIdentity& opened);

}  // namespace farlod
