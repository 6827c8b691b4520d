// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// What a file or a folder is to GDAL.
enum class MapKind {
  unknown,
  features,
  raster,
  only_by_name  ///< its format may name other files, and the user did not name this one
};

/// By its content, and for some formats by its name. A file with features and a raster counts as features. A raster without a
/// place on the map, such as a photograph, is `unknown`.
[[nodiscard]] MapKind map_kind_of(const InputFile& file);

}  // namespace farlod::ingest
