// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "farlod/building_origin.hpp"
#include "results/raster/raster_writer.hpp"
#include "results/table/morphology_table.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// All that the program knows about an output format. Options, memory planning and help read it here, and choose nothing by the
/// format's name. How to add a format: CONTRIBUTING.md.
struct OutputFormat {
  std::string_view name;
  std::array<std::string_view, 2> endings = {};  ///< of file names, lower case, with the dot; the second may be empty
  bool is_picture = false;      ///< a drawing of the values of --grid, also for --preview, or of the sky above --at
  bool is_folder = false;       ///< rather than a file; an older one is replaced
  bool holds_bounds = false;    ///< whether --bounds has bands or columns in it
  bool is_for_solweig = false;  ///< whose reader needs the values of add_for_solweig: they are computed without being asked for
  bool is_solweig_kit = false;  ///< shadow patches are among them, and files of the surface are beside them

  /// Makes the writer of a file for the values of --grid; null where the format holds tables alone.
  std::unique_ptr<RasterWriter> (*raster_writer)(const RasterFrame& frame, const std::filesystem::path& path) = nullptr;
  /// Bytes that that writer holds in memory besides the tile that is being written.
  std::uint64_t (*raster_writer_bytes)(const RasterFrame& frame) = nullptr;

  /// Writes a row for each receiver of --points, --along or --at; null where the format holds no tables.
  void (*write_points)(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) = nullptr;
  /// Makes the writer of the tables of --surfaces; null where the format holds no tables.
  std::unique_ptr<SurfaceTablesWriter> (*surface_tables_writer)(const TableFrame& frame,
                                                                const std::filesystem::path& path) = nullptr;

  /// Writes a row for each cell of the grid, or polygon in its place; null where the format holds no such table.
  void (*write_forms)(const FormTable& table, const TableFrame& frame, const std::filesystem::path& path) = nullptr;

  /// What a file has for each band of a pixel, for each row of a table, and for each of its values, more or less: for estimates.
  double bytes_of_pixel = 0.0, bytes_of_row = 0.0, bytes_of_value = 0.0;

  [[nodiscard]] constexpr bool holds_rasters() const { return raster_writer != nullptr && !is_picture; }
  [[nodiscard]] constexpr bool holds_tables() const { return write_points != nullptr; }
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

[[nodiscard]] std::string name_of(CityFileFormat format);
/// The format of a city file that the ending of its name promises, in capitals or not.
[[nodiscard]] std::optional<CityFileFormat> city_format_of(const std::filesystem::path& path);
/// For messages: ".gml, .xml or .citygml".
[[nodiscard]] std::string endings_of(CityFileFormat format);

}  // namespace farlod
