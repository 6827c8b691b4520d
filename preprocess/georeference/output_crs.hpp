// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "city/located_city.hpp"
#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// The CRS of the city: `wish` if it is not empty; else the CRS of the input if it is projected in metres, the same in metres if
/// it is projected in another unit, and UTM on its datum otherwise. `typical` is a place of the city in `input`. A projection
/// with a large scale error at the city, such as Web Mercator, is not used. Throws InputError when `wish` cannot be used.
[[nodiscard]] Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish);

/// The city frame with its origin at `centre`, rounded to whole metres.
[[nodiscard]] Georeference georeference_around(Point2d centre, const Crs& output);

}  // namespace farlod::georeference
