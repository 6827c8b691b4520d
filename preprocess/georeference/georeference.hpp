// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "city/tree.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// The CRS of the city: `wish` if it is not empty; else the CRS of the input if it is projected in metres, the same in metres if
/// it is projected in another unit, and UTM on its datum otherwise. `typical` is a place of the city in `input`. A projection
/// with a large scale error at the city, such as Web Mercator or a far zone, is not used. Throws InputError when `wish` cannot be
/// used.
[[nodiscard]] Crs choose_output_crs(const Crs& input, Point2d typical, const std::string& wish);

/// The city frame with its origin at `centre`, rounded to whole metres.
[[nodiscard]] Georeference georeference_around(Point2d centre, const Crs& output);

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

/// Brings the trees of an inventory to the city frame.
///   (1) the CRS is that of the file; of a file that does not say it, or names one that is not known, `fallback_crs`; where that
///       is empty, and the file says nothing, that of the package
///   (2) the order of axes is found as it is for buildings, and told as it is there (axes_swapped, zone_in_easting,
///       unlikely_place); besides, degrees that lie at the city only in the other order are taken in that
///   (3) trees without a place in the CRS of the package are left out, and reported together (tree_outside_of_grid)
/// Problems of the file that have positions get a longitude and latitude. Throws InputError when the file names a CRS that is not
/// known and there is no other, or when its coordinates cannot be in its CRS.
void locate_trees(SourceTrees& trees, const std::string& fallback_crs, const Georeference& georeference, Report& report);

}  // namespace farlod::georeference
