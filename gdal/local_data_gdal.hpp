// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>

// Private to the wrappers of GDAL: it names its classes.

namespace farlod {

/// What GDAL may read for a file. Some formats name other files, addresses on the network, or code.
enum class GdalReach {
  /// The file itself, and companions beside it whose names follow from its own: for files that the user did not name one by one.
  own_data,
  /// Besides, other files on this computer that the file names, such as the tiles of a VRT mosaic: for files that the user named.
  /// Never the network, a database or the memory of the program, and no code is run.
  local_files
};

/// Opens a file to read it (`kinds`: GDAL_OF_RASTER or GDAL_OF_VECTOR). Nothing is written beside it, nor fetched from an address
/// in it. Null where GDAL does not know what it is, or cannot read it. `encoding`: of the names and texts of a Shapefile,
/// whatever that says itself. Throws InputError when it would read more than `reach` allows, and says what to do.
[[nodiscard]] GDALDatasetUniquePtr open_within(GdalReach reach, const std::filesystem::path& file, unsigned int kinds,
                                               const std::optional<std::string>& encoding = {});

/// Whether a format that `reach` allows knows the file.
[[nodiscard]] bool is_known_within(GdalReach reach, const std::filesystem::path& file, unsigned int kinds);

}  // namespace farlod
