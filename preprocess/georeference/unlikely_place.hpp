// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "georeference/crs.hpp"
#include "georeference/source_coordinates.hpp"

namespace farlod::georeference {

/// A text that the file does not lie in the area of use of its CRS, or that its buildings are too large, with a possible reason:
/// another unit, or a model of a site without a place on the map. Empty when the place is plausible. `p_map`: the typical place,
/// easting or longitude first.
[[nodiscard]] std::optional<std::string> doubt_about_place(const Crs& crs, Point2d p_map, std::optional<double> building_extent);

}  // namespace farlod::georeference
