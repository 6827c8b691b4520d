// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/problem.hpp"
#include "city/source.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/footprints/footprint_settings.hpp"

namespace farlod::ingest {

/// Reads footprints in any vector format that GDAL knows, and raises them to prisms as high as FootprintHeights says. Of several
/// layers the first that holds areas (and the height field asked for) is read; the report names the others. A feature of several
/// polygons is one building, each polygon a part. Elevations of the vertices are ignored, unless the layer holds bodies in space
/// (polyhedral surfaces, or several polygons of which some are steep): those are written as they are.
/// Throws InputError when there is nothing to read, or nothing that tells the heights.
[[nodiscard]] SourceCity read_footprints(const InputFile& file, const FootprintSettings& settings, Report& report);

}  // namespace farlod::ingest
