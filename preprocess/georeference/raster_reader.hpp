// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "city/city_model.hpp"
#include "city/tree.hpp"
#include "farlod/box.hpp"
#include "georeference/georeference.hpp"

namespace farlod::georeference {

/// A raster of heights as GDAL opens it. What the user did not name himself must not lead to other files.
struct TerrainFile {
  TerrainFile(std::filesystem::path file, bool named = true) : path(std::move(file)), is_named(named) {}  // NOLINT: a file is one

  std::filesystem::path path;
  bool is_named = true;
  /// The name of the raster to read, of a file of several. A file of one may have another one, unless it is the city.
  std::optional<std::string> layer = {};
  std::optional<std::string> crs = {};  ///< that holds in place of its own
  bool is_input = false;                ///< it came among the inputs, beside buildings, and not as a terrain
};

/// The place of a raster of heights, by its own metadata.
struct TerrainExtent {
  std::string crs_wkt;  ///< empty when the file has no CRS
  Box2d box;            ///< easting or longitude in x, over whole pixels
  double pixel = 0.0;   ///< the width of a pixel
};

/// Throws InputError when the file is not a raster, or has no place on the map.
[[nodiscard]] TerrainExtent read_terrain_extent(const TerrainFile& file);

/// For rasters that are the city: where --crs overrules what they say themselves, by the rules of crs_of_inputs, it is theirs
/// from here on. Reports two_crs, crs_unknown and unlikely_place as for a city file.
void take_crs_of_inputs(std::span<TerrainFile> files, const GeoreferenceSettings& settings, Report& report);

/// The frame of a city that consists of a terrain or surface model alone. The CRS is chosen by the same rules as for buildings;
/// that of the first file counts, and so does the place of those in the same CRS. An output CRS that is not meant for that is
/// reported (unlikely_place).
[[nodiscard]] Georeference georeference_of_terrain(std::span<const TerrainFile> files, const GeoreferenceSettings& settings,
                                                   Report& report);
[[nodiscard]] inline Georeference georeference_of_terrain(const TerrainFile& file, const GeoreferenceSettings& settings,
                                                          Report& report) {
  return georeference_of_terrain(std::span(&file, 1), settings, report);
}

/// Reads the heights of the ground from band 1 of any raster that GDAL reads.
///   (1) a north-up raster in the output CRS is read as it is; the nodes of the terrain are the centres of its pixels
///   (2) any other raster is resampled into the output CRS: a terrain bilinearly at a similar resolution, a surface model
///   (without
///       `wanted_city`) in squares of a third of its pixels, each with the height of the nearest one, which is told
///   (3) pixels that are masked or have no data are empty; the scale and offset of the band are applied
///   (4) heights are in metres: by the unit of the band, else by the vertical unit of the CRS, else, if that is projected, by its
///       horizontal unit
///   (5) numbers that stand for no data though the raster does not declare it are empty, and reported (undeclared_no_data)
///   (6) heights whose vertical system is another one than that of the city are brought to that, or reported (another_datum)
/// A raster without a CRS is in `fallback_crs` or, if that is empty, in the output CRS. Only the part over `wanted_city` is read,
/// and one pixel around it; without it, the raster is the city. An unlikely place is reported as that of a city file is
/// (resolve). Throws InputError when the file cannot be read, does not cover `wanted_city`, or is in degrees and its CRS is not.
[[nodiscard]] TerrainRaster read_terrain(const TerrainFile& file, const std::string& fallback_crs,
                                         const Georeference& georeference, std::optional<Box2d> wanted_city, Report& report);
/// The same, but empty when the file does not cover `wanted_city`.
[[nodiscard]] std::optional<TerrainRaster> find_terrain(const TerrainFile& file, const std::string& fallback_crs,
                                                        const Georeference& georeference, std::optional<Box2d> wanted_city,
                                                        Report& report);
/// Throws the InputError that such a file does not meet `wanted_city`, and where both lie; `before` begins the message.
[[noreturn]] void refuse_terrain(const TerrainFile& file, const std::string& before, const std::string& fallback_crs,
                                 const Georeference& georeference, const Box2d& wanted_city);
/// The vertical system that the file says; empty where it says none.
[[nodiscard]] std::string heights_of_terrain(const TerrainFile& file);
/// Reads the tiles of one terrain, of which some may lie elsewhere. Throws InputError when all do, and as for a single file.
/// Where neither the city nor a file before says its vertical system, that of a file is the one of those after it.
/// Without `wanted_city`, heights that are hardly those of a city are reported (implausible_size).
[[nodiscard]] TerrainRaster read_terrain(std::span<const TerrainFile> files, const std::string& fallback_crs,
                                         const Georeference& georeference, const std::optional<Box2d>& wanted_city,
                                         Report& report);
/// One net of several, as fine as the finest. Where they overlap, later ones lie on top, but for where they have no data.
[[nodiscard]] TerrainRaster merged(const std::vector<TerrainRaster>& tiles);

/// A surface model that is turned or in another CRS than the city.
struct TurnedSurface {
  std::vector<Point3d> points_city;  ///< the centres of its pixels
  std::vector<std::string> notes;    ///< for the user
};
/// Empty where `read_terrain` reads the raster as it is. Else each pixel with a height is a point, so that walls are as steep as
/// in a raster that is not turned; reports as `read_terrain` does. Throws InputError when the file cannot be read.
[[nodiscard]] std::optional<TurnedSurface> read_turned_surface(const TerrainFile& file, const std::string& fallback_crs,
                                                               const Georeference& georeference, Report& report);

/// The files of a canopy.
struct CanopyFiles {
  std::filesystem::path tops;
  std::optional<std::filesystem::path> trunks;
  std::optional<std::string> layer = {};  ///< of a file of several rasters
};

/// Throws InputError when one of the files is no raster that can be opened, or has no place on the map: told before the long
/// stages.
void require_canopy(const CanopyFiles& files);

/// Reads band 1 of a raster of the tops of crowns, and of one of the heights at which they begin.
///   (1) a raster in the output CRS whose pixels are squares is read as it is, however it is turned
///   (2) any other raster is brought into squares of the output CRS, each with the height of the nearest pixel
///   (3) where a pixel has its centre, the raster of trunks is asked for the pixel there, whatever its extent and resolution
///   (4) units, masks and rasters without a CRS are as for a terrain
/// Only what lies over `wanted_city` is read. The second value is for the user: what of this was done. Throws InputError when a
/// file cannot be read, or when the tops do not meet `wanted_city`; Cancelled.
[[nodiscard]] std::pair<CanopyRaster, std::vector<std::string>> read_canopy(const CanopyFiles& files,
                                                                            const std::string& fallback_crs,
                                                                            const Georeference& georeference,
                                                                            const Box2d& wanted_city,
                                                                            const std::stop_token& stop = {});

}  // namespace farlod::georeference
