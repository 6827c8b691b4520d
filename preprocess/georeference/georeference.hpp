// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "city/located_city.hpp"
#include "city/source.hpp"
#include "farlod/problem.hpp"

namespace farlod::georeference {

struct GeoreferenceSettings {
  std::string crs;      ///< of inputs without a CRS; if all inputs have one, of all of them instead; may be empty
  std::string out_crs;  ///< projected, in metres; empty: that of the first input, the same in metres, or UTM
  /// An input that is not among the sources, such as a raster, has no CRS: `crs` is for it, and overrules none of the sources.
  bool crs_is_for_another = false;
};

/// Brings all files into one city frame. For every building of every file, and every point of its relief:
///   (1) the order of axes and the units are those of the CRS; where the coordinates of a file contradict its CRS, that is
///   reported
///       (axes_swapped, zone_in_easting, unlikely_place)
///   (2) if the output CRS is that of the file, the coordinates are those of the file minus the origin
///   (3) it is in the city, or is reported as outside_of_projection or far_away
/// Problems of files with a known CRS get a longitude and latitude. Throws InputError when the CRS of a file is missing, unknown
/// or obviously wrong for its coordinates, when the output CRS is not projected in metres, and when neither a building nor a
/// point of a relief is left. The report is filled up to that point.
[[nodiscard]] LocatedCity georeference(std::vector<SourceCity> sources, const GeoreferenceSettings& settings, Report& report);

}  // namespace farlod::georeference
