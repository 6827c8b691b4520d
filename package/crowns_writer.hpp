// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "package/crowns_of_city.hpp"
#include "package/manifest.hpp"

namespace farlod {

/// Writes `crowns.bin` into the folder of a package, and returns what the manifest says of it (Manifest::canopy). Where there is
/// no crown, it returns nothing, and there is no file. Throws OutputError.
[[nodiscard]] std::optional<package::CanopyFile> write_canopy(const std::filesystem::path& folder, CrownsOfCity& crowns);

}  // namespace farlod
