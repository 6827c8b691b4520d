// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/evaluation.hpp"
#include "results/spool_file.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Text of a CSV file (RFC 4180, lines end with a line feed), written field by field and row by row.
class CsvText {
 public:
  /// Quoted, with quotes doubled, where RFC 4180 demands it.
  CsvText& field(std::string_view text);
  CsvText& whole(std::uint64_t number);
  /// As append_millimetres; empty where there is no value.
  CsvText& millimetres(double value);
  CsvText& millimetres(std::optional<double> value);
  /// As append_svf; empty where there is no answer.
  CsvText& svf(std::optional<double> value);
  /// The shortest decimal that reads back as the same number; empty where it is NaN.
  CsvText& number(float value);
  CsvText& fields(std::initializer_list<std::string_view> texts);
  void end_row();

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void begin_field();

  std::string bytes_;
  bool row_begins_ = true;
};

// Tables as CSV; docs/stages/results.md says how rows, numbers and missing answers are written. All functions throw OutputError.

/// Columns: id, the attributes, x_m, y_m, z_m, height_above_ground_m, with normals azimuth_deg and tilt_deg, then the answers.
void write_points_csv(const PointRows& rows, const AnswerColumns& columns, const std::filesystem::path& path);

/// Columns: building, surface, kind, x_m, y_m, z_m, azimuth_deg, tilt_deg, area_m2, then the answers. Rows come in parts, in any
/// order; until it is committed, they wait in a spool file.
class SurfacePointsCsv {
 public:
  SurfacePointsCsv(const AnswerColumns& columns, const std::filesystem::path& path);
  /// Each part comes once at the most.
  void write_part(std::size_t part, std::span<const SurfacePoint> rows);
  /// Writes the parts in the order of their numbers. The file appears now.
  void commit();

 private:
  struct Place {
    std::uint64_t begin, bytes;
  };
  std::filesystem::path path_;
  std::string header_;
  AnswerColumns columns_;
  SpoolFile spool_;
  std::map<std::size_t, Place> parts_;
};

/// Columns: building, surface, kind, azimuth_deg, tilt_deg, area_m2, receivers, nodata, QUANTITY_mean, QUANTITY_min,
/// QUANTITY_max, covered_area_m2, those of area_columns_of(), and surface_id where have_ids().
void write_surfaces_csv(std::span<const SurfaceMean> rows, const AnswerColumns& columns, const std::filesystem::path& path);

/// Columns: building, roof_area_m2, wall_area_m2, receivers, nodata, QUANTITY_roofs, QUANTITY_walls, covered_roof_area_m2,
/// covered_wall_area_m2, and those of area_columns_of().
void write_buildings_csv(std::span<const BuildingMean> rows, const AnswerColumns& columns, const std::filesystem::path& path);

/// The three tables of surfaces: NAME.csv, NAME.surfaces.csv, NAME.buildings.csv.
class SurfaceTablesCsv : public SurfaceTablesWriter {
 public:
  SurfaceTablesCsv(const AnswerColumns& columns, const std::filesystem::path& path)
      : columns_(columns), path_(path), receivers_(columns, path) {}
  void write_part(std::size_t part, std::span<const SurfacePoint> rows) override { receivers_.write_part(part, rows); }
  [[nodiscard]] std::vector<std::filesystem::path> commit(std::span<const SurfaceMean> surfaces,
                                                          std::span<const BuildingMean> buildings) override;

 private:
  AnswerColumns columns_;
  std::filesystem::path path_;
  SurfacePointsCsv receivers_;
};

/// Writes receivers with their value and their exact value as CSV: x_m, y_m, z_m, `quantity`, `quantity`_exact. Throws
/// OutputError.
void write_verification_csv(std::span<const VerifiedReceiver> receivers, const std::string& quantity,
                            const std::filesystem::path& path);

}  // namespace farlod
