// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "farlod/morphology.hpp"
#include "run/cell_faces.hpp"

namespace farlod {

/// Where the wind comes from, as vectors of length 1 in the plan of the grid frame.
using WindDirections = std::array<Point2d, wind_directions>;

/// All of CellAmounts but `plan_area_m2`.
[[nodiscard]] CellAmounts amounts_of(const CellFaces& faces, const WindDirections& winds);

}  // namespace farlod
