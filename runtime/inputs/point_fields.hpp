// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace farlod {

/// Which columns of a table, or fields of a layer, say what of a point.
struct PointFields {
  std::optional<std::size_t> id, x, y, z, azimuth, tilt;
  std::vector<std::size_t> attributes = {};  ///< all others, and an id that has another name than `id`
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
