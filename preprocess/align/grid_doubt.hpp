// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "base/grid.hpp"
#include "city/city_model.hpp"

namespace farlod::align {

/// A text that the grid is very large for its buildings, with what would explain it: a few stray buildings without which it would
/// be a tenth, or less than one building for 12.5 km². Empty when it is not. The size of the cells makes no difference.
[[nodiscard]] std::optional<std::string> doubt_about_grid(const CityModel& city, const Grid& grid);

}  // namespace farlod::align
