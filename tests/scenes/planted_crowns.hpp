// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "package/crowns_of_city.hpp"
#include "package/package_reader.hpp"

namespace farlod::scenes {

/// For the crowns of a package that is on disk.
[[nodiscard]] CrownsOfCity crowns_for(const std::filesystem::path& package);

/// Puts crowns into a package that is on disk, as if its city had been packed with them.
void plant(CrownsOfCity& crowns, const std::filesystem::path& package);

/// So many trees by chance on the ground of a package's city, beside its buildings and below them: crowns of all shapes, 2 to 8 m
/// wide and with tops 5 to 18 m above the ground. Always the same.
[[nodiscard]] CrownsOfCity random_crowns(const PackageReader& package, std::size_t count, std::uint64_t seed = 1);

}  // namespace farlod::scenes
