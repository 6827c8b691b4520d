// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/foundations.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "tiles/base_points.hpp"

namespace farlod::tiles {
namespace {

/// Depth of a foundation below the ground, which may bend between the places that are sampled.
constexpr double below_ground_m = 0.5;

/// Calls `visit` for each place of a border at which it is compared with the ground.
template <class Visit>
void visit_places(const HorizonSegment& border, const Visit& visit) {
  const auto& [a, b] = border.segment;
  const int intervals = ground_sampling_intervals(norm(horizontal(b - a)));
  for (int k = 0; k <= intervals; ++k) visit(a + static_cast<double>(k) / intervals * (b - a));
}

/// The largest height of the borders above the ground.
double largest_gap_m(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height) {
  double largest_m = 0.0;
  for (const HorizonSegment& border : foot)
    visit_places(border, [&](const Point3d& p) { largest_m = std::max(largest_m, p.z - ground_height(horizontal(p))); });
  return largest_m;
}

}  // namespace

std::optional<Foundation> take_foundation(std::span<const Point3d> building_points, std::vector<HorizonSegment>& undersides,
                                          const GroundHeightAt& ground_height) {
  double lowest_m = std::numeric_limits<double>::infinity(), least_gap_m = lowest_m;
  double highest_m = -lowest_m;
  for (const Point3d& p : building_points) {
    lowest_m = std::min(lowest_m, p.z);
    highest_m = std::max(highest_m, p.z);
  }
  Foundation foundation{lowest_m + lowest_floor_thickness_m, 0.0, {}, {}};
  // (1) A person can walk below the floor from all sides
  for (const Point3d& p : building_points)
    if (p.z <= foundation.top_m) least_gap_m = std::min(least_gap_m, p.z - ground_height(horizontal(p)));
  if (least_gap_m > least_clearance_m) return std::nullopt;
  // (2) Separate the borders of the lowest floor from the other lower borders
  const auto is_foot = [&](const HorizonSegment& s) { return std::max(s.segment.a.z, s.segment.b.z) <= foundation.top_m; };
  const auto foot = std::stable_partition(undersides.begin(), undersides.end(), std::not_fn(is_foot));
  if (foot == undersides.end()) return std::nullopt;
  // (3) The building is thinner than the gap below it
  foundation.gap_m = largest_gap_m({foot, undersides.end()}, ground_height);
  if (foundation.gap_m > highest_m - lowest_m) return std::nullopt;
  foundation.place = foot->segment.a;
  foundation.walls = foundation_walls({foot, undersides.end()}, ground_height);
  undersides.erase(foot, undersides.end());
  return foundation;
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

}  // namespace farlod::tiles
