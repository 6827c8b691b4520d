// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "inputs/requested_zones.hpp"

namespace farlod {

/// Reads the polygons of a layer of a vector file, a zone for each feature, and takes them from their CRS to that of the package;
/// a layer that says none is in that. `layer` may be empty where only one holds polygons. A feature without a polygon, or with
/// something else besides, is refused. Throws PointsError, InputError.
[[nodiscard]] RequestedZones read_zones_gdal(const std::filesystem::path& path, const std::string& layer,
                                             const std::string& package_crs);

}  // namespace farlod
