// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs/point_fields.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "base/point_columns.hpp"

namespace farlod {

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
  fields.azimuth = find_column(names, azimuth_names, refuse);
  fields.tilt = find_column(names, tilt_names, refuse);
  if (!fields.azimuth || !fields.tilt) fields.azimuth = fields.tilt = std::nullopt;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const bool is_named_id = n == fields.id && lower_case(names[n]) == id_names[0];
    if (!is_named_id && n != fields.x && n != fields.y && n != fields.z && n != fields.azimuth && n != fields.tilt)
      fields.attributes.push_back(n);
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
