// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace farlod::ingest {

/// The file, in GDAL's memory, that tells its driver of OpenStreetMap (its option OSM_CONFIG_FILE) which closed ways are areas.
/// GDAL's own leaves out parts of buildings, which become lines then, and it may not be installed.
[[nodiscard]] const std::string& file_of_openstreetmap_areas();

}  // namespace farlod::ingest
