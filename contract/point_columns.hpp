// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

/// The names of the columns of a table of points, in small letters. Both programs read such tables.
namespace farlod::point_columns {

inline constexpr std::array<std::string_view, 3> id_names{"id", "name", "fid"};
inline constexpr std::array<std::string_view, 5> x_names{"x", "x_m", "easting", "lon", "longitude"};
inline constexpr std::array<std::string_view, 5> y_names{"y", "y_m", "northing", "lat", "latitude"};
inline constexpr std::array<std::string_view, 4> z_names{"z", "z_m", "height_m", "elevation"};

}  // namespace farlod::point_columns
