// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/grid.hpp"
#include "farlod/box.hpp"

namespace farlod {

/// The box in the city frame around what all cells of a grid cover together.
[[nodiscard]] inline Box2d outline_city(const Grid& grid) {
  const auto [low, high] = grid.rectangle();
  Box2d outline;
  for (const Point2d corner : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}})
    outline.add(grid.rotation.city_from_grid(corner));
  return outline;
}

}  // namespace farlod
