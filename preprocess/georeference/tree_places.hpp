// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "city/located_city.hpp"
#include "city/tree.hpp"
#include "farlod/problem.hpp"

namespace farlod::georeference {

/// Brings the trees of an inventory to the city frame.
///   (1) the CRS is that of the file; of a file that does not say it, or names one that is not known, `fallback_crs`; where that
///       is empty, and the file says nothing, that of the package
///   (2) the order of axes is found as it is for buildings, and told as it is there (axes_swapped, zone_in_easting,
///       unlikely_place); besides, degrees that lie at the city only in the other order are taken in that
///   (3) trees without a place in the CRS of the package are left out, and reported together
/// Problems of the file that have positions get a longitude and latitude. Throws InputError when the file names a CRS that is not
/// known and there is no other, or when its coordinates cannot be in its CRS.
void locate_trees(SourceTrees& trees, const std::string& fallback_crs, const Georeference& georeference, Report& report);

}  // namespace farlod::georeference
