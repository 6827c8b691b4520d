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

/// Calls `visit` with each place of a border at which the ground is looked at.
template <class Visit>
void visit_places(const HorizonSegment& border, const Visit& visit) {
  const auto& [a, b] = border.segment;
  const auto steps = static_cast<int>(std::ceil(std::max(1.0, norm(horizontal(b - a)) / ground_asked_every_m)));
  for (int k = 0; k <= steps; ++k) visit(a + static_cast<double>(k) / steps * (b - a));
}

}  // namespace

double largest_gap_m(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height) {
  double largest_m = 0.0;
  for (const HorizonSegment& border : foot)
    visit_places(border, [&](const Point3d& p) { largest_m = std::max(largest_m, p.z - ground_height(horizontal(p))); });
  return largest_m;
}

std::vector<std::array<Point3d, 3>> foundation_walls(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height) {
  std::vector<std::array<Point3d, 3>> walls;
  for (const HorizonSegment& border : foot) {
    const auto& [a, b] = border.segment;
    double lowest_m = std::min(a.z, b.z);
    visit_places(border, [&](const Point3d& p) { lowest_m = std::min(lowest_m, ground_height(horizontal(p))); });
    const Point3d below_a{a.x, a.y, lowest_m - below_ground_m}, below_b{b.x, b.y, lowest_m - below_ground_m};
    walls.push_back({a, below_a, below_b});
    walls.push_back({a, below_b, b});
  }
  return walls;
}

}  // namespace farlod
