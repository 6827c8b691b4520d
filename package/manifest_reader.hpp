// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// Of a cell that a package can speak of: beyond it, multiples of the cell edge are no longer exact (exact_cell_edge_m).
inline constexpr std::int32_t farthest_cell_index = std::int32_t{1} << 29;

/// XXH3-64 with seed 0: what a manifest says at its end of the text before (package::ManifestSeal).
[[nodiscard]] std::uint64_t checksum_of_manifest(std::string_view sealed);

/// Checks the text of a manifest; `name` is for messages. What it takes in memory is at most 64 times the text.
/// Throws PackageUnusable (another version of the format) or PackageDamaged (its checksum is not that of its text, a key is
/// missing or impossible).
[[nodiscard]] package::Manifest manifest_from_text(std::string_view text, const std::string& name);

/// Reads and checks `manifest.json` of a package's folder.
/// Throws PackageUnusable (no package there, another version of the format) or PackageDamaged.
[[nodiscard]] package::Manifest read_manifest(const PackageFolder& package_folder);
[[nodiscard]] package::Manifest read_manifest(const std::filesystem::path& package_folder);

}  // namespace farlod
