// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "farlod/problem.hpp"
#include "georeference/crs.hpp"
#include "georeference/file_axes.hpp"
#include "georeference/input_crs.hpp"

namespace farlod::georeference {

/// A file with x as the easting or longitude and heights in metres.
struct ResolvedSource {
  SourceCity source;
  Crs crs;
  Point2d typical;  ///< a typical place of the file
  FileAxes axes;    ///< the axes of the file before
};

/// Resolves CRS, axes and units of a source that has buildings or a relief. Reports problems of its CRS (two_crs, crs_unknown)
/// and of its coordinates (axes_swapped, zone_in_easting, unlikely_place), each once for the whole file. Throws InputError when
/// the coordinates are in degrees and the CRS is projected, or the other way round.
[[nodiscard]] ResolvedSource resolve(SourceCity source, const InputCrs& given, Report& report);

}  // namespace farlod::georeference
