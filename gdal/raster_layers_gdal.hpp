// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Private to the wrappers of GDAL: it names its classes.

namespace farlod {

/// One of the rasters of a file: a variable of netCDF, or a table of tiles of a GeoPackage.
struct RasterLayer {
  std::string name;
  std::string gdal_name;  ///< by which GDAL opens it
};

/// Empty where a file holds one raster at the most.
[[nodiscard]] std::vector<RasterLayer> raster_layers(GDALDataset& file);

/// Whether a file that is open has a raster of this name.
[[nodiscard]] bool has_raster_layer(GDALDataset& file, const std::string& name);

/// Opens one of them, by the format of the file. Null where it is no raster.
[[nodiscard]] GDALDatasetUniquePtr open_raster_layer(GDALDataset& file, const RasterLayer& layer);

/// Which raster of a file is meant.
struct RasterChoice {
  std::optional<std::string> name = {};
  /// The name is surely meant for this file, and not for another one of the same run: a file that has one raster must have it by
  /// this name, too.
  bool is_for_this = false;
};

/// The raster of a file that is open: the one of the name, or else the only one that has a place on the map. Null when it has
/// none. Throws InputError where it has several, or none of the name, and names those that there are.
[[nodiscard]] GDALDatasetUniquePtr chosen_raster(GDALDatasetUniquePtr file, const std::filesystem::path& path,
                                                 const RasterChoice& choice);

}  // namespace farlod
