// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "results/raster/raster_writer.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// What a file of a format holds, and therefore which receivers it is for.
enum class OutputKind {
  raster,   ///< the values of --grid
  picture,  ///< a drawing of the values of --grid, also for --preview, or of the sky above --at
  table     ///< a row for each receiver of --points, --at or --surfaces
};

/// All that the program knows about an output format. Options, memory planning and help read it here, and choose nothing by the
/// format's name. How to add a format: CONTRIBUTING.md.
struct OutputFormat {
  std::string_view name;
  std::array<std::string_view, 2> endings;  ///< of file names, lower case, with the dot; the second may be empty
  OutputKind kind;
  bool holds_bounds;  ///< whether --bounds has bands or columns in it

  /// Rasters and pictures: makes the writer of a file; null for tables.
  std::unique_ptr<RasterWriter> (*raster_writer)(const RasterFrame& frame, const std::filesystem::path& path);
  /// Rasters and pictures: bytes that the writer holds in memory besides the tile that is being written; null for tables.
  std::uint64_t (*raster_writer_bytes)(const RasterFrame& frame);

  /// Tables: writes the points; null for rasters and pictures.
  void (*write_points)(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path);
  /// Tables: makes the writer of the tables of surfaces; null for rasters and pictures.
  std::unique_ptr<SurfaceTablesWriter> (*surface_tables_writer)(const TableFrame& frame, const std::filesystem::path& path);
};

/// The formats of this build, in the order of the help text. GeoTIFF needs GDAL.
[[nodiscard]] std::span<const OutputFormat> output_formats();

/// The format of a file by the ending of its name, in capitals or not; null when no format has this ending.
[[nodiscard]] const OutputFormat* output_format_of(const std::filesystem::path& path);

/// The endings of all formats that fulfil a condition, for messages, such as ".tif, .tiff".
template <class Condition>
[[nodiscard]] std::string endings_where(const Condition& condition) {
  std::string list;
  for (const OutputFormat& format : output_formats())
    for (const std::string_view ending : format.endings)
      if (!ending.empty() && condition(format)) list.append(list.empty() ? "" : ", ").append(ending);
  return list;
}

}  // namespace farlod
