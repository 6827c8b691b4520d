// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/crowns_everywhere.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "package/crowns_of_city.hpp"

namespace farlod::plausibility {

void report_crowns_everywhere(const CanopyRaster& canopy, const Grid& grid, Report& report) {
  constexpr std::size_t fewest_cells = 100;
  constexpr float least_crown_m = 1.0F;
  constexpr double most_crowned = 0.95;
  std::size_t cells = 0, crowned = 0;
  float low_m = std::numeric_limits<float>::infinity(), high_m = -low_m;
  for (std::size_t row = 0; row < canopy.rows; ++row)
    for (std::size_t column = 0; column < canopy.columns; ++column) {
      if (!holds(grid, grid.rotation.grid_from_city(canopy.centre(column, row)))) continue;
      ++cells;
      const float top_m = canopy.top_m[row * canopy.columns + column];
      if (!(top_m >= least_crown_m)) continue;  // NaN: no data
      ++crowned;
      low_m = std::min(low_m, top_m);
      high_m = std::max(high_m, top_m);
    }
  if (cells < fewest_cells || static_cast<double>(crowned) <= most_crowned * static_cast<double>(cells)) return;
  report.add({ProblemCode::another_datum, canopy.source, "the whole file",
              fmt::format("{} of {} cells of the canopy have a crown, {:.1f} to {:.1f} m high: are they elevations "
                          "(--canopy-absolute), or is it a surface model in the place of the canopy?",
                          crowned, cells, low_m, high_m)});
}

}  // namespace farlod::plausibility
