// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/foundations.hpp"

#include <algorithm>
#include <cmath>

#include "tiles/ground_contact.hpp"

namespace farlod {
namespace {

/// The ground may bend between the places where it is asked.
constexpr double below_ground_m = 0.5;

}  // namespace

std::vector<std::array<Point3d, 3>> foundation_walls(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height) {
  std::vector<std::array<Point3d, 3>> walls;
  for (const HorizonSegment& border : foot) {
    const auto& [a, b] = border.segment;
    const auto steps = static_cast<int>(std::ceil(std::max(1.0, norm(horizontal(b - a)) / ground_asked_every_m)));
    double lowest_m = std::min(a.z, b.z);
    for (int k = 0; k <= steps; ++k)
      lowest_m = std::min(lowest_m, ground_height(horizontal(a + static_cast<double>(k) / steps * (b - a))));
    const Point3d below_a{a.x, a.y, lowest_m - below_ground_m}, below_b{b.x, b.y, lowest_m - below_ground_m};
    walls.push_back({a, below_a, below_b});
    walls.push_back({a, below_b, b});
  }
  return walls;
}

}  // namespace farlod
