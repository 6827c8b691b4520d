// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// What GDAL takes a file, or a folder, for.
enum class MapKind { unknown, features, raster };

/// By its content, and for some formats by its name. What can be both is taken for features. A raster counts when it has a place
/// on the map: a photograph is none.
[[nodiscard]] MapKind map_kind_of(const InputFile& file);

}  // namespace farlod::ingest
