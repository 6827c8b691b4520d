// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "results/picture/drawing.hpp"

namespace farlod {

Polygon disc(PagePoint middle, double radius, Colour colour) {
  constexpr int corners = 24;
  Polygon polygon{{}, colour};
  for (int n = 0; n < corners; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / corners;
    polygon.corners.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
  }
  return polygon;
}

}  // namespace farlod
