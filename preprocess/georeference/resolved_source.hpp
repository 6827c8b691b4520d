// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/problem.hpp"
#include "city/source.hpp"
#include "georeference/crs.hpp"
#include "georeference/file_axes.hpp"
#include "georeference/input_crs.hpp"

namespace farlod::georeference {

/// A file whose x is the easting or longitude, and whose heights are in metres.
struct ResolvedSource {
  SourceCity source;
  Crs crs;
  Point2d typical;  ///< a place of it
  FileAxes axes;    ///< how the file counts
};

/// Resolves CRS, axes and units of a source that has buildings or a relief. Reports what is said of its CRS (two_crs,
/// crs_unknown), and what is odd about its coordinates (axes_swapped, zone_in_easting, unlikely_place), each once for the whole
/// file. Throws InputError when the coordinates are degrees and the CRS counts in metres, or the other way round.
[[nodiscard]] ResolvedSource resolve(SourceCity source, const InputCrs& input, Report& report);

}  // namespace farlod::georeference
