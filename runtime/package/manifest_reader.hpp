// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "contract/package/manifest.hpp"

namespace farlod {

/// Reads and checks `manifest.json` of a package's folder.
/// Throws PackageUnusable (no package there, another version of the format) or PackageDamaged (a key is missing or impossible).
[[nodiscard]] package::Manifest read_manifest(const std::filesystem::path& package_folder);

}  // namespace farlod
