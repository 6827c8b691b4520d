// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/grid.hpp"
#include "city/tree.hpp"
#include "farlod/problem.hpp"

namespace farlod::plausibility {

/// another_datum where the heights of crowns above the ground look like elevations, or like a surface model in the place of a
/// canopy: of at least 100 cells in the grid, more than 95 % have a crown 1 m high and higher. No town is a forest without gaps.
void report_crowns_everywhere(const CanopyRaster& canopy, const Grid& grid, Report& report);

}  // namespace farlod::plausibility
