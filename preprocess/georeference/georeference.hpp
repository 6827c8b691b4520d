// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "city/located_city.hpp"
#include "city/problem.hpp"
#include "city/source.hpp"

namespace farlod::georeference {

struct GeoreferenceSettings {
  std::string crs;      ///< of inputs that do not say theirs; of all, where every one of them does; empty: there is none
  std::string out_crs;  ///< projected, in metres; empty: the first input's own, its metric twin, or UTM
  /// There is an input that does not say its CRS and is none of the sources, such as a raster: then `crs` overrules none of them.
  bool crs_is_for_another = false;
};

/// Puts all files into one city frame. For every building of every file, and every point of its relief:
///   (1) latitude and northing first is read as such, degrees are never taken for metres, nor feet for metres; where a file
///       counts otherwise than its CRS says, that is reported (axes_swapped, zone_in_easting, unlikely_place)
///   (2) in an input's own metric CRS the coordinates stay those of the file, minus the origin
///   (3) it is in the city, or in the report as outside_of_projection
/// Problems of files whose CRS is known by then get their longitude and latitude.
/// Throws InputError when a file's CRS is missing, unknown or evidently not that of its coordinates, when the output CRS
/// is not projected in metres, and when neither a building nor a point of a relief is left. What was found by then is reported.
[[nodiscard]] LocatedCity georeference(std::vector<SourceCity> sources, const GeoreferenceSettings& settings, Report& report);

}  // namespace farlod::georeference
