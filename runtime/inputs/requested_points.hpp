// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/error.hpp"

namespace farlod {

/// What a file says of its points besides where they are: a table of text, which goes to the output as it is.
class Attributes {
 public:
  Attributes() = default;
  explicit Attributes(std::vector<std::string> names) : names_(std::move(names)) {}

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  void rename(std::size_t column, std::string name) { names_[column] = std::move(name); }

  /// Adds the row of the next point, in the order of the names. A field that the row lacks is empty.
  void add_row(std::span<const std::string> fields);
  /// Adds a column behind the others, with a field for each of `rows` points.
  void add_column(const std::string& name, std::size_t rows, const std::function<std::string(std::size_t)>& field_of);
  [[nodiscard]] std::size_t row_count() const { return names_.empty() ? 0 : ends_.size() / names_.size(); }
  [[nodiscard]] std::string_view value(std::size_t row, std::size_t column) const;

  /// The table of some of its rows.
  [[nodiscard]] Attributes rows(std::span<const std::size_t> chosen) const;

  /// What all of it takes in memory.
  [[nodiscard]] std::size_t bytes() const { return text_.size() + ends_.size() * sizeof(std::uint64_t); }

 private:
  std::vector<std::string> names_;
  std::string text_;                 // all fields, one behind the other
  std::vector<std::uint64_t> ends_;  // of each field in it
};

/// A file of points cannot be read or used. The message names the file and the place in it, says what is wrong, and what to do.
class PointsError : public InputError {
 public:
  using InputError::InputError;
};

/// Where a point looks, in degrees as in files.
struct RequestedNormal {
  double azimuth_deg = 0.0;  ///< clockwise from true north, −360 to 360
  double tilt_deg = 0.0;     ///< 0 looks straight up, 90 level; 0 to 180
};

/// A point whose sky the user wants to know, in the CRS of the file.
struct RequestedPoint {
  std::string id;           ///< as the file says, or the number of the point from 1
  double x = 0.0, y = 0.0;  ///< easting and northing, or longitude and latitude; NaN of a row that cannot be read
  std::optional<double> z;
  std::optional<RequestedNormal> normal;      ///< none: it looks straight up
  std::optional<double> above_ground_m = {};  ///< where it has no z; none: as the program is told

  [[nodiscard]] bool has_place() const { return !std::isnan(x) && !std::isnan(y); }
};

/// The points of a file.
struct RequestedPoints {
  std::vector<RequestedPoint> points;
  Attributes attributes;     ///< a row for each point
  bool has_normals = false;  ///< the file has fields for them, even if they are empty
  /// As the file says, also by columns of longitudes and latitudes; empty: it says none; absent: it is a table, which need not.
  std::optional<std::string> crs_wkt = {};
  std::size_t skipped_features = 0;  ///< of the file, which are no points; rows of a table that cannot be read
  std::vector<std::string> notes;    ///< what the user should know of how the file was read, a sentence each
  /// The column that z is from, where its name may also mean a height above the ground; else empty.
  std::string doubtful_z = {};
};

/// A height above ground, of a field that may be empty. Where it is none, `refuse` is called with what is wrong; it throws.
template <class Refuse>
[[nodiscard]] std::optional<double> above_ground_of(std::optional<double> height_m, const Refuse& refuse) {
  constexpr double highest_m = 10'000.0;
  if (height_m && !(0.0 <= *height_m && *height_m <= highest_m))
    refuse("the height above ground is not between 0 and 10,000 m; a height above sea level is called z");
  return height_m;
}

/// The normal of two fields, of which an empty one has no number: none where both are empty; a tilt of 0 needs no azimuth.
/// Where the two are no normal, `refuse` is called with what is wrong; it throws.
template <class Refuse>
[[nodiscard]] std::optional<RequestedNormal> normal_of(std::optional<double> azimuth_deg, std::optional<double> tilt_deg,
                                                       const Refuse& refuse) {
  if (!azimuth_deg && !tilt_deg) return std::nullopt;
  if (!tilt_deg) refuse("there is an azimuth and no tilt; give both, or neither to let the point look straight up");
  if (!(0.0 <= *tilt_deg && *tilt_deg <= 180.0)) refuse("the tilt is not between 0 (straight up) and 180 degrees");
  if (!azimuth_deg && *tilt_deg > 0.0) refuse("there is a tilt and no azimuth; give both, or a tilt of 0");
  const double azimuth = azimuth_deg.value_or(0.0);
  if (!(-360.0 <= azimuth && azimuth <= 360.0)) refuse("the azimuth is not between -360 and 360 degrees");
  return RequestedNormal{azimuth, *tilt_deg};
}

/// Which columns of a table, or fields of a layer, say what of a point.
struct PointFields {
  std::optional<std::size_t> id, x, y, z, azimuth, tilt;
  std::optional<std::size_t> above_ground = {};  ///< none in a table that has a z
  std::vector<std::size_t> attributes = {};      ///< all others, and an id that has another name than `id`
};

/// Where a file says where a point is. What is called x in a file with geometries is an attribute.
enum class PlacesIn : std::uint8_t { fields, geometry };

/// Finds them by their names (base/point_columns.hpp). An azimuth without a tilt, or the other way round, is no normal but an
/// attribute. Where two mean the same, `refuse` is called with what is wrong; it throws.
[[nodiscard]] PointFields point_fields(std::span<const std::string> names, PlacesIn places,
                                       const std::function<void(const std::string& what)>& refuse);

/// A finite number like 123.4, with or without its sign.
[[nodiscard]] std::optional<double> number_in(std::string_view field);

}  // namespace farlod
