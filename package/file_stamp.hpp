// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "package/manifest.hpp"
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

/// The identity of a file as it is now; all zero where there is none.
[[nodiscard]] FileIdentity identity_of(const std::filesystem::path& path);

/// Throws PackageDamaged where a file of an open package is not what it was when it was opened.
void require_unchanged(const PackageFile& file, const FileIdentity& opened);

[[nodiscard]] package::FileStamp stamp_of(std::span<const std::byte> bytes);
/// Reads the file piece by piece. Throws InputError when it cannot be read.
[[nodiscard]] package::FileStamp stamp_of(const std::filesystem::path& path);

/// Whether the files of a block are those that were written.
[[nodiscard]] bool are_whole(const std::filesystem::path& package, const package::BlockFiles& files);
/// Whether its files besides the blocks are whole: crowns, the places that surfaces come from, the far terrain,
/// the heights of pixels.
[[nodiscard]] bool are_others_whole(const std::filesystem::path& package, const package::Manifest& manifest);

}  // namespace farlod
