// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "farlod/region.hpp"
#include "inputs/requested_points.hpp"

namespace farlod {

/// Whether a file is for read_points_gdal, by the ending of its name. Tables (.csv, .tsv, .txt) are not.
[[nodiscard]] bool is_vector_file(const std::filesystem::path& path);

/// Reads points from a layer of a vector file: GeoPackage, GeoJSON, Shapefile, FlatGeobuf, or whatever else GDAL reads.
///   (1) A point of a multipoint is a point with the fields of the whole.
///   (2) x is the easting or longitude, y the northing or latitude. z is that of the geometry; fields move no point.
///   (3) The id is the field `id`, else `name`, else `fid` (which may be the file's own number of a feature), else the number of
///       the point. Normals are the fields `azimuth` and `tilt`, or `azimuth_deg` and `tilt_deg`. All fields but `id` and these
///       are attributes; numbers have all their digits.
///   (4) Features that are no points are skipped, and told in a note.
/// `layer` may be empty where there is only one. A file without points is refused, unless it `may_be_empty`. Throws PointsError.
[[nodiscard]] RequestedPoints read_points_gdal(const std::filesystem::path& path, const std::string& layer,
                                               bool may_be_empty = false);

/// All fields of all features of a layer, with a geometry or without; none where the file has no such layer, or cannot be opened.
/// Throws PointsError where it cannot be read to its end.
[[nodiscard]] std::optional<Attributes> read_table_gdal(const std::filesystem::path& path, const std::string& layer);

/// Where points are placed along lines.
struct LineSampling {
  double spacing_m = 1.0;
  std::string crs;          ///< of the lines, whatever their file says; empty: the file's own, or else the package's
  std::string package_crs;  ///< in which metres count, and in which the points are
};

/// Places points along the lines of a vector file: ⌈length / spacing⌉ of them on each line, in the middles of equal parts, so
/// that each stands for as much of the line. They have the fields of their line as attributes, and the distance from its
/// beginning as `along_m`; their ids are numbers. A part of a multiline is a line; features that are no lines are skipped, and
/// told in a note. Throws PointsError.
[[nodiscard]] RequestedPoints read_lines_gdal(const std::filesystem::path& path, const std::string& layer,
                                              const LineSampling& sampling);

/// Reads the polygons of all layers of a vector file, and takes them from their CRS to that of the package. What is no polygon is
/// left out; a file without any is refused. Throws PointsError.
[[nodiscard]] Region read_region_gdal(const std::filesystem::path& path, const std::string& package_crs);

}  // namespace farlod
