// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "city/located_city.hpp"
#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// The CRS that the city is put into: `wish` where there is one, else the input's own when it is projected in metres, its
/// metric twin when projected in feet, else UTM on its datum. `typical` is a place of the city in `input`.
/// A projection whose metres are not metres at the city (Web Mercator) never serves. Throws InputError when `wish` cannot.
[[nodiscard]] Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish);

/// The city frame whose origin is `centre`, rounded to whole metres.
[[nodiscard]] Georeference georeference_around(Point2d centre, const Crs& output);

}  // namespace farlod::georeference
