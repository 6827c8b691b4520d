// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "city/canopy_raster.hpp"
#include "city/located_city.hpp"
#include "farlod/box.hpp"

namespace farlod::georeference {

/// The files of a canopy.
struct CanopyFiles {
  std::filesystem::path tops;
  std::optional<std::filesystem::path> trunks;
};

/// Throws InputError when one of the files is no raster that can be opened, or has no place on the map: told before the long
/// stages.
void require_canopy(const CanopyFiles& files);

/// Reads band 1 of a raster of the tops of crowns, and of one of the heights at which they begin.
///   (1) a raster in the output CRS whose pixels are squares is read as it is, however it is turned
///   (2) any other raster is brought into squares of the output CRS, each with the height of the nearest pixel
///   (3) where a pixel has its centre, the raster of trunks is asked for the pixel there, whatever its extent and resolution
///   (4) units, masks and rasters without a CRS are as for a terrain
/// Only what lies over `wanted_city` is read. The second value is for the user: what of this was done. Throws InputError when a
/// file cannot be read, or when the tops do not meet `wanted_city`; Cancelled.
[[nodiscard]] std::pair<CanopyRaster, std::vector<std::string>> read_canopy(const CanopyFiles& files,
                                                                            const std::string& fallback_crs,
                                                                            const Georeference& georeference,
                                                                            const Box2d& wanted_city,
                                                                            const std::stop_token& stop = {});

}  // namespace farlod::georeference
