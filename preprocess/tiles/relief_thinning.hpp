// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// Selects the points of a relief that shape the ground of a rectangle. Reliefs come in tiles that are far larger than a city.
///   (1) All points within a distance of L of the rectangle are kept, where L is the longer side of the rectangle.
///   (2) Between L and 2L one point is kept for each square of side L/4, between 2L and 4L one for each square of side L/2, and
///       so on. A coarse relief keeps all its points, and a fine one keeps enough of them.
///   (3) The result is sorted by place, and does not depend on the order of the points.
[[nodiscard]] std::vector<Point3d> thinned_relief(std::vector<Point3d> points_grid, const Box2d& rectangle);

}  // namespace farlod::tiles
