// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Reads footprints in any vector format that GDAL knows, and builds prisms of the heights that FootprintHeights finds. Of
/// several layers, the first with areas (and with the height field that the settings name) is read; the others are reported. A
/// feature of several polygons is one building, each polygon a part of it. Elevations of vertices are ignored, unless the
/// features are bodies in space (polyhedral surfaces, or several polygons of which some are steep): bodies are read as they are.
/// Throws InputError when there is nothing to read, or when no height is known.
[[nodiscard]] SourceCity read_footprints(const InputFile& file, const FootprintSettings& settings, Report& report);

}  // namespace farlod::ingest
