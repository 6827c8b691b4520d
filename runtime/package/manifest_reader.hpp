// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "contract/package/manifest.hpp"

namespace farlod {

/// Of a cell that a package can speak of: beyond it, multiples of the cell edge are no longer exact (exact_cell_edge_m).
inline constexpr std::int32_t farthest_cell_index = std::int32_t{1} << 29;

/// Reads and checks `manifest.json` of a package's folder.
/// Throws PackageUnusable (no package there, another version of the format) or PackageDamaged (a key is missing or impossible).
[[nodiscard]] package::Manifest read_manifest(const std::filesystem::path& package_folder);

}  // namespace farlod
