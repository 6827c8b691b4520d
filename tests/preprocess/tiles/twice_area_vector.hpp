// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tiles/exact_cutting_cgal.hpp"

namespace farlod::tiles {

/// Twice the area vector of a closed polygon.
inline ExactPoint twice_area_vector(const std::vector<ExactCorner>& polygon) {
  ExactPoint sum{Rational(0), Rational(0), Rational(0)};
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum = sum + cross(polygon[k - 1].p_grid - polygon[0].p_grid, polygon[k].p_grid - polygon[0].p_grid);
  return sum;
}

}  // namespace farlod::tiles
