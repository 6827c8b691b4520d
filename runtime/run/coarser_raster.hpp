// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "farlod/raster.hpp"

namespace farlod {

/// How many times coarser the pixels are that a dry run looks at: cells of more pixels would take long.
[[nodiscard]] inline std::size_t coarsening_of(const RasterPlan& plan, double cell_edge_m) {
  constexpr double most_along_cell = 300.0, wanted_along_cell = 200.0;
  const double along_cell = cell_edge_m / plan.step_m;
  return along_cell > most_along_cell ? static_cast<std::size_t>(std::ceil(along_cell / wanted_along_cell)) : 1;
}

/// A plan of the same place, whose pixels are so many times as long and wide.
[[nodiscard]] inline RasterPlan coarser(const RasterPlan& plan, std::size_t times) {
  return {plan.north_west_m, plan.step_m * static_cast<double>(times), (plan.columns + times - 1) / times,
          (plan.rows + times - 1) / times};
}

}  // namespace farlod
