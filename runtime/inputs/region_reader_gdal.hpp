// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "farlod/region.hpp"

namespace farlod {

/// Reads the polygons of all layers of a vector file, and takes them from their CRS to that of the package. What is no polygon is
/// left out; a file without any is refused. Throws PointsError.
[[nodiscard]] Region read_region_gdal(const std::filesystem::path& path, const std::string& package_crs);

}  // namespace farlod
