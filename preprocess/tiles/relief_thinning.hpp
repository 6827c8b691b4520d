// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// Reliefs come in tiles far larger than a city. Of their points these shape the ground of a rectangle:
///   (1) all that are no farther from it than its longer side
///   (2) beyond, one for each square of a quarter of that side, of half of it from twice as far on, and so on: so that a coarse
///       relief keeps its shape, as all of its points are far from each other, and a fine one loses no more than it has too much
///   (3) the same points in another order give the same, ordered by place
[[nodiscard]] std::vector<Point3d> thinned_relief(std::vector<Point3d> points_grid, const Box2d& rectangle);

}  // namespace farlod
