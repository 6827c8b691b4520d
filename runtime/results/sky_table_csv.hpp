// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>

#include "results/sky_table.hpp"
#include "results/spool_file.hpp"

namespace farlod {

// Tables as CSV (RFC 4180, lines end with a line feed): a header row, units in the column names, lengths to the millimetre,
// view factors with six digits, empty where there is no answer. `quantity` ("svf" or "svf_solid") names the columns of
// the answers. All throw OutputError.

/// Whether tables of receivers have the columns QUANTITY_low and QUANTITY_high, too.
enum class BoundsColumns { no, yes };

/// Columns: id, x_m, y_m, z_m, QUANTITY. `row_of` makes the n-th of `count` rows when its turn comes.
void write_points_csv(std::size_t count, const std::function<PointRow(std::size_t n)>& row_of, const std::string& quantity,
                      BoundsColumns bounds, const std::filesystem::path& path);
void write_points_csv(std::span<const PointRow> rows, const std::string& quantity, BoundsColumns bounds,
                      const std::filesystem::path& path);

/// Columns: building, surface, kind, x_m, y_m, z_m, azimuth_deg, tilt_deg, area_m2, QUANTITY. The rows come in parts, in any
/// order, and stand in the table in the order of the parts' numbers; until it is committed, they wait in a file beside it.
class SurfacePointsCsv {
 public:
  SurfacePointsCsv(const std::filesystem::path& path, const std::string& quantity, BoundsColumns bounds);
  /// Each part comes once at the most.
  void write_part(std::size_t part, std::span<const SurfacePointRow> rows);
  /// The file appears.
  void commit();

 private:
  struct Place {
    std::uint64_t begin, bytes;
  };
  std::filesystem::path path_;
  std::string header_;
  BoundsColumns bounds_;
  SpoolFile waiting_;
  std::map<std::size_t, Place> parts_;
};

/// The same for a table as a whole.
void write_surface_points_csv(std::span<const SurfacePointRow> rows, const std::string& quantity, BoundsColumns bounds,
                              const std::filesystem::path& path);

/// Columns: building, surface, kind, azimuth_deg, tilt_deg, area_m2, receivers, nodata, QUANTITY_mean, QUANTITY_min,
/// QUANTITY_max.
void write_surfaces_csv(std::span<const SurfaceRow> rows, const std::string& quantity, const std::filesystem::path& path);

/// Columns: building, roof_area_m2, wall_area_m2, receivers, nodata, QUANTITY_roofs, QUANTITY_walls.
void write_buildings_csv(std::span<const BuildingRow> rows, const std::string& quantity, const std::filesystem::path& path);

}  // namespace farlod
