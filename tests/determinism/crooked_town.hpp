// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {

/// Houses that stand askew over many borders of cells and blocks.
[[nodiscard]] inline CityModel crooked_town() {
  scenes::SceneBuilder builder({11.3, -7.9, 40.0}, Angle::degrees(23.4));
  for (int n = 0; n < 120; ++n) {
    const Point2d low{14.7 * (n % 12), 13.1 * (n / 12)};
    builder.add_box({low, low + Point2d{6.0 + n % 5, 5.0 + n % 7}}, 0.01 * (n % 3), 5.0 + (n * 7) % 31);
  }
  return builder.city();
}

[[nodiscard]] inline Grid crooked_grid() { return scenes::grid_covering(crooked_town(), Angle::degrees(3.0), 25.0, 3, 4); }

}  // namespace farlod
