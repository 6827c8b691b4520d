// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/surfaces.hpp"
#include "inputs/requested_points.hpp"
#include "results/provenance.hpp"

namespace farlod {

/// A receiver that the user named, with its answer; no answer when it lies inside a building, or far from the city.
struct PointRow {
  std::string id;
  Point2d p_projected;             ///< easting and northing; NaN of a row that cannot be read
  std::optional<double> height_m;  ///< where it stands; unknown inside a building
  std::optional<double> svf;
  std::optional<double> low, high;  ///< certain bounds, where asked for
  /// Where it looks, clockwise from true north and from straight up; none: straight up.
  std::optional<double> azimuth_deg = {}, tilt_deg = {};
  std::span<const float> further = {};        ///< as many as AnswerColumns::further; NaN where there is no answer
  std::optional<double> above_ground_m = {};  ///< unknown also where there is no ground

  [[nodiscard]] bool has_place() const { return !std::isnan(p_projected.x); }
};

/// Whether tables of receivers have columns for the bounds.
enum class BoundsColumns { no, yes };

/// Whether tables of surfaces and buildings have columns for the area that gets at least some irradiation.
enum class ThresholdColumns { no, yes };

/// The columns of the answers: QUANTITY, with bounds QUANTITY_low and QUANTITY_high, then further ones.
struct AnswerColumns {
  std::string quantity;  ///< "svf" or "svf_solid"
  BoundsColumns bounds = BoundsColumns::no;
  std::vector<ColumnDescription> further = {};
  ThresholdColumns areas_above = ThresholdColumns::no;
};

/// Columns of a table, and what its file says of the whole of it.
struct TableFrame {
  AnswerColumns columns;
  std::string crs_wkt = {};      ///< of all coordinates
  std::optional<int> epsg = {};  ///< the same CRS by its code, where it has one
  Angle convergence = {};        ///< true azimuth = grid azimuth + convergence
  Provenance provenance = {};
  const Package* package = nullptr;  ///< which formats that show the city read; null: they have no geometry
};

/// The rows of a table of points, made one by one, so that nobody has to hold them all.
struct PointRows {
  std::size_t count = 0;
  std::function<PointRow(std::size_t n)> row;
  const Attributes* attributes = nullptr;  ///< a row for each point; null: there are none
  bool normals = false;                    ///< whether there are columns for them
};

/// The names of the columns of the answers.
[[nodiscard]] std::vector<std::string> names_of(const AnswerColumns& columns);

/// The names of the columns of a table of points besides those of its attributes: id, x_m, y_m, z_m,
/// height_above_ground_m, those of normals, answers.
[[nodiscard]] std::vector<std::string> own_columns_of_points(bool normals, const AnswerColumns& columns);

/// The value of the k-th further column, of a receiver or a mean; NaN where there is no answer, and therefore no values.
template <class Values>
[[nodiscard]] float further_value(const Values& values, std::size_t k) {
  return values.empty() ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(values[k]);
}

/// The file of another table of --surfaces: OUT.csv → OUT.surfaces.csv.
[[nodiscard]] std::filesystem::path table_beside(const std::filesystem::path& output, const std::string& what);

/// Writes the tables of --surfaces: one of receivers, one of surfaces, one of buildings. All functions throw OutputError.
class SurfaceTablesWriter {
 public:
  SurfaceTablesWriter() = default;
  virtual ~SurfaceTablesWriter() = default;
  SurfaceTablesWriter(const SurfaceTablesWriter&) = delete;
  SurfaceTablesWriter& operator=(const SurfaceTablesWriter&) = delete;

  /// Receivers come in parts, in any order, each part once at the most. In the table, parts are ordered by their numbers.
  virtual void write_part(std::size_t part, std::span<const SurfacePoint> rows) = 0;
  /// Writes the other two tables. The files appear now, and not before; that of the receivers, the first path returned, last.
  [[nodiscard]] virtual std::vector<std::filesystem::path> commit(std::span<const SurfaceMean> surfaces,
                                                                  std::span<const BuildingMean> buildings) = 0;
};

}  // namespace farlod
