// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "georeference/crs.hpp"
#include "georeference/source_coordinates.hpp"

namespace farlod::georeference {

/// Says that a file does not lie where its CRS is meant for, or that its buildings are larger than any, and what would explain
/// it: another unit, or a model of a site that has no place on the map. Empty when nothing speaks against the place.
/// `p_map`: the typical place, easting or longitude first.
[[nodiscard]] std::optional<std::string> doubt_about_place(const Crs& crs, Point2d p_map, std::optional<double> building_extent);

}  // namespace farlod::georeference
