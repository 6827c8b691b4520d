// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "city/located_city.hpp"
#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod {

/// A CRS as an input names it, or else as --crs does.
struct NamedCrs {
  Crs crs;
  bool longitude_first = false;  ///< the name itself says so
};

/// The CRS of `file`: what it says itself (`definition`), or `fallback` where it says nothing or nothing that is known.
/// Throws InputError when neither helps.
[[nodiscard]] NamedCrs crs_of_input(const std::string& file, const std::string& definition, const std::string& fallback);

/// The CRS that the city is put into: `wish` where there is one, else the input's own when it is projected in metres, its
/// metric twin when projected in feet, else UTM on its datum. `typical` is a place of the city in `input`.
/// A projection whose metres are not metres at the city (Web Mercator) never serves. Throws InputError when `wish` cannot.
[[nodiscard]] Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish);

/// The city frame whose origin is `centre`, rounded to whole metres.
[[nodiscard]] Georeference georeference_around(Point2d centre, const Crs& output);

}  // namespace farlod
