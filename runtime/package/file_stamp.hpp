// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "contract/package/manifest.hpp"

namespace farlod {

/// Throws PackageDamaged when a file is not the one that the manifest names.
void check_stamp(const std::filesystem::path& path, std::span<const std::byte> bytes, const package::FileStamp& stamp);

}  // namespace farlod
