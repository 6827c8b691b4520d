// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farlod/box.hpp"
#include "gdal/local_data_gdal.hpp"
#include "gdal/raster_layers_gdal.hpp"

// Private to the wrappers of GDAL: it names its classes.

namespace farlod {

/// East of pixel (column, row) = [0] + column·[1] + row·[2], north = [3] + column·[4] + row·[5].
using GeoTransform = std::array<double, 6>;

/// Throws InputError: the file, what is wrong with it, and what GDAL said last.
[[noreturn]] void refuse_raster(const std::filesystem::path& file, const std::string& what);

/// Opens a raster that has a band; of a file of several, the one that is chosen. Throws InputError, which says `what_it_is_not`
/// of the file, or names the rasters in it.
[[nodiscard]] GDALDatasetUniquePtr open_height_raster(GdalReach reach, const std::filesystem::path& file,
                                                      const std::string& what_it_is_not, const RasterChoice& choice = {});

/// Throws InputError where the raster has no place on the map.
[[nodiscard]] GeoTransform geo_transform_of(GDALDataset& dataset, const std::filesystem::path& file);

/// The unit of the band in metres, if it names a known one.
[[nodiscard]] std::optional<double> named_unit_m(GDALRasterBand& band);

/// How a raster is brought into another CRS.
struct WarpWay {
  std::string from_wkt, to_wkt;
  const char* resampling = "bilinear";  ///< as GDAL calls it
  std::optional<double> step = {};      ///< of the pixels, which are squares; empty: a similar resolution
  std::optional<Box2d> extent = {};     ///< with `step`
};
/// The raster in another CRS; pixels are computed when they are read. Empty where GDAL cannot.
[[nodiscard]] GDALDatasetUniquePtr warped_raster(GDALDataset& dataset, const WarpWay& way);

/// Reads pixels of a row. Those that are masked, have no data, or are not finite become NaN. Scale and offset of the band are not
/// applied. Returns false when the file is cut short.
[[nodiscard]] bool read_pixels(GDALRasterBand& band, int column, int row, std::vector<double>& values);

/// GDAL keeps what it has read, up to a twentieth of the memory that there is: for what is read once, call this now and then.
void forget_old_blocks();

}  // namespace farlod
