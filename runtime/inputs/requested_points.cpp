// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/requested_points.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "base/point_columns.hpp"

namespace farlod {

void Attributes::add_row(std::span<const std::string> fields) {
  for (std::size_t column = 0; column < names_.size(); ++column) {
    if (column < fields.size()) text_ += fields[column];
    ends_.push_back(text_.size());
  }
}

void Attributes::add_column(const std::string& name, std::size_t rows, const std::function<std::string(std::size_t)>& field_of) {
  std::vector<std::string> names = names_, fields(names_.size() + 1);
  names.push_back(name);
  Attributes wider(std::move(names));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < names_.size(); ++column) fields[column] = value(row, column);
    fields.back() = field_of(row);
    wider.add_row(fields);
  }
  *this = std::move(wider);
}

std::string_view Attributes::value(std::size_t row, std::size_t column) const {
  const std::size_t n = row * names_.size() + column;
  const std::size_t begin = n == 0 ? 0 : ends_[n - 1];
  return std::string_view(text_).substr(begin, ends_[n] - begin);
}

Attributes Attributes::rows(std::span<const std::size_t> chosen) const {
  Attributes result(names_);
  std::vector<std::string> fields(names_.size());
  for (const std::size_t row : chosen) {
    for (std::size_t column = 0; column < names_.size(); ++column) fields[column] = value(row, column);
    result.add_row(fields);
  }
  return result;
}

using namespace point_columns;

PointFields point_fields(std::span<const std::string> names, PlacesIn places,
                         const std::function<void(const std::string& what)>& refuse) {
  PointFields fields;
  for (std::size_t n = 0; n < id_names.size() && !fields.id; ++n)
    fields.id = find_column(names, std::span(id_names).subspan(n, 1), refuse);
  if (places == PlacesIn::fields) {
    fields.x = find_column(names, x_names, refuse);
    fields.y = find_column(names, y_names, refuse);
    fields.z = find_column(names, z_names, refuse);
  }
  if (!fields.z) fields.above_ground = find_column(names, above_ground_names, refuse);
  fields.azimuth = find_column(names, azimuth_names, refuse);
  fields.tilt = find_column(names, tilt_names, refuse);
  if (!fields.azimuth || !fields.tilt) fields.azimuth = fields.tilt = std::nullopt;
  // Answers have places in metres: degrees come back beside them
  const bool in_degrees = fields.x && are_degrees(names[*fields.x]);
  for (std::size_t n = 0; n < names.size(); ++n) {
    const bool is_named_id = n == fields.id && lower_case(names[n]) == id_names[0];
    const bool is_place = !in_degrees && (n == fields.x || n == fields.y);
    // The geometry of features may have a z: then the field is an attribute
    const bool is_height = n == fields.z || (places == PlacesIn::fields && n == fields.above_ground);
    if (!is_named_id && !is_place && !is_height && n != fields.azimuth && n != fields.tilt) fields.attributes.push_back(n);
  }
  return fields;
}

std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace farlod
