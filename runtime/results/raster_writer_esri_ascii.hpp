// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "results/sky_raster.hpp"

namespace farlod {

/// Writes an ESRI ASCII grid, and its CRS to a .prj file beside it (none when the raster has no CRS). The WKT is written as it
/// is; most readers of .prj files know WKT 1 only (see esri_wkt_of).
/// The format knows numbers only: pixels without an answer hold -9999, which the header declares. Throws OutputError.
void write_esri_ascii(const SkyRaster& raster, const std::filesystem::path& path);

}  // namespace farlod
