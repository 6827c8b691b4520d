// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "city/located_city.hpp"
#include "city/source.hpp"
#include "farlod/problem.hpp"

namespace farlod {

struct GeoreferenceSettings {
  std::string crs;      ///< of inputs that do not say theirs, or say one that nobody knows; empty: there is none
  std::string out_crs;  ///< projected, in metres; empty: the first input's own, its metric twin, or UTM
};

/// Puts all files into one city frame. For every building of every file:
///   (1) latitude and northing first is read as such, degrees are never taken for metres, nor feet for metres
///   (2) in an input's own metric CRS the coordinates stay those of the file, minus the origin
///   (3) it is in the city, or in the report as outside_of_projection
/// Problems of files whose CRS is known by then get their longitude and latitude.
/// Throws InputError when a file's CRS is missing, unknown or evidently not that of its coordinates, when the output CRS
/// is not projected in metres, and when no building is left.
[[nodiscard]] LocatedCity georeference(std::vector<SourceCity> sources, const GeoreferenceSettings& settings, Report& report);

}  // namespace farlod
