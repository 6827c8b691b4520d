// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/look_around.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace farlod {
namespace {

/// Between two boxes in the plane; 0 where they meet.
double distance_m(const Box2d& a, const Box2d& b) {
  return norm(
      Point2d{std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0}), std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0})});
}

/// What rises so high, nowhere nearer than this, stays below this slope.
double slope_at_most(double rise_m, double nearest_m) { return rise_m / nearest_m * (1.0 + bound_rounding) + bound_rounding; }

struct Waiting {
  double distance_m;
  std::uint32_t node;
  bool operator<(const Waiting& o) const { return std::pair(distance_m, node) > std::pair(o.distance_m, o.node); }
};

}  // namespace

LookAround::LookAround(const CityHorizon& city, const CellPlace& place, const BinBorders& borders, double tolerance)
    : city_(city),
      place_(place),
      borders_(borders),
      bins_(borders.bins()),
      tolerance_(tolerance),
      found_{{}, ViewpointHorizons(place.square.high.x, place.patches, bins_), {}},
      settled_(place.patches.layers(), 0.0),
      over_cell_(borders_) {
  found_.hidden.assign(std::size_t{place.patches.layers()} * bins_.count, 0.0F);
  limits_.resize(found_.hidden.size());
  update_limits({0, bins_.count});
}

Surroundings LookAround::run() && {
  std::priority_queue<Waiting> waiting;
  const auto push = [&](std::uint32_t n) {
    if (!city_.nodes()[n].outline.empty()) waiting.push({distance_m(outline_of(city_.nodes()[n]), place_.square), n});
  };
  if (!city_.nodes().empty()) push(0);
  while (!waiting.empty()) {
    const auto [distance_m, n] = waiting.top();
    waiting.pop();
    const CityHorizon::Node& node = city_.nodes()[n];
    if (hide_node(node, distance_m)) continue;
    if (node.children != 0) {
      push(node.children);
      push(node.children + 1);
    } else if (!place_.near.contains(node.cell)) {
      add_leaf(node, distance_m);
    }
  }
  return std::move(found_);
}

Box2d LookAround::outline_of(const CityHorizon::Node& node) const {
  return {node.outline.low - place_.corner, node.outline.high - place_.corner};
}

/// The bins in which some place of a box can be seen from some place of the cell, which it does not meet.
LookAround::BinRange LookAround::bins_of(const Box2d& box) const {
  const Point2d toward = 0.5 * (box.low + box.high) - 0.5 * (place_.square.low + place_.square.high);
  // The difference of the two boxes is a box: its corners bound the azimuths
  const Box2d difference{box.low - place_.square.high, box.high - place_.square.low};
  double from = 0.0, to = 0.0;
  for (const Point2d d : {difference.low, Point2d{difference.high.x, difference.low.y}, difference.high,
                          Point2d{difference.low.x, difference.high.y}}) {
    const double turn = std::atan2(toward.x * d.y - toward.y * d.x, dot(toward, d));
    from = std::min(from, turn);
    to = std::max(to, turn);
  }
  if (to - from >= std::numbers::pi) return {0, bins_.count};
  const double middle = std::atan2(toward.y, toward.x);
  const std::int64_t first = bins_.unwrapped_bin_of(middle + from - bound_rounding);
  return {first, static_cast<std::size_t>(bins_.unwrapped_bin_of(middle + to + bound_rounding) + 1 - first)};
}

/// When all of a node is surely below what stands before it, its bound is noted, and it is done.
bool LookAround::hide_node(const CityHorizon::Node& node, double distance_m) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  if (node.z_high_m <= levels_m.front()) return true;
  if (distance_m <= 0.0) return false;
  const BinRange range = bins_of(outline_of(node));
  bool hidden = true;
  for (std::size_t l = 0; l < levels_m.size() && hidden && node.z_high_m > levels_m[l]; ++l) {
    const double slope = slope_at_most(node.z_high_m - levels_m[l], distance_m), *limits = &limits_[l * bins_.count];
    for_each_bin(bins_, range.first, range.count,
                 [&](std::size_t, std::uint32_t bin) { hidden = hidden && slope <= limits[bin]; });
  }
  for (std::size_t l = 0; l < levels_m.size() && hidden && node.z_high_m > levels_m[l]; ++l) {
    const auto slope = static_cast<float>(slope_at_most(node.z_high_m - levels_m[l], distance_m));
    float* row = &found_.hidden[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) { row[bin] = std::max(row[bin], slope); });
  }
  return hidden;
}

void LookAround::add_leaf(const CityHorizon::Node& leaf, double distance_m) {
  const BinRange range = distance_m > 0.0 ? bins_of(outline_of(leaf)) : BinRange{0, bins_.count};
  remember_what_is_settled(range);
  bool drawn = false;
  for (std::uint32_t n = leaf.first_obstacle; n < leaf.first_obstacle + leaf.obstacle_count; ++n) {
    const Obstacle& obstacle = city_.obstacles()[n];
    if (is_settled(obstacle) || hide_obstacle(obstacle)) continue;
    found_.candidates.push_back(n);
    // What does not stand may be seen under: it hides nothing for certain
    if (!obstacle.is_edge) continue;
    const auto p = obstacle.corners_from(place_.corner);
    found_.views.add(p[0], p[1]);
    drawn = true;
  }
  if (drawn) update_limits(range);
}

void LookAround::remember_what_is_settled(const BinRange& range) {
  for (std::size_t l = 0; l < settled_.size(); ++l) {
    float lowest = std::numeric_limits<float>::infinity();
    const float* row = &found_.hidden[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) { lowest = std::min(lowest, row[bin]); });
    settled_[l] = lowest;
  }
}

/// Whether an obstacle is so low that `hidden` bounds it already, wherever in the leaf at hand it stands. A bound without
/// azimuths is enough to tell for most.
bool LookAround::is_settled(const Obstacle& obstacle) const {
  Box2d outline;
  for (const Point3d& p : obstacle.corners_from(place_.corner)) outline.add(horizontal(p));
  const double nearest_m = distance_m(outline, place_.square), z_high_m = obstacle.z_high_m();
  for (std::size_t l = 0; l < settled_.size() && z_high_m > place_.patches.levels_m()[l]; ++l)
    if (!(slope_at_most(z_high_m - place_.patches.levels_m()[l], nearest_m) <= settled_[l])) return false;
  return true;
}

/// The same as for a node, for one obstacle.
bool LookAround::hide_obstacle(const Obstacle& obstacle) {
  over_cell_.look_at(obstacle, place_.corner, place_.square);
  if (over_cell_.surrounds() || rises(obstacle)) return false;
  const std::vector<float>& levels_m = place_.patches.levels_m();
  for (EdgeOverSquare& edge : over_cell_.edges())
    for (std::size_t l = 0; l < levels_m.size() && obstacle.z_high_m() > levels_m[l]; ++l) {
      const std::span<const double> upper = edge.upper(levels_m[l]);
      float* row = &found_.hidden[l * bins_.count];
      for_each_bin(bins_, edge.first_bin(), upper.size(),
                   [&](std::size_t n, std::uint32_t bin) { row[bin] = std::max(row[bin], static_cast<float>(upper[n])); });
    }
  return true;
}

/// Whether the obstacle at hand may be seen over what stands before it.
bool LookAround::rises(const Obstacle& obstacle) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  bool rises = false;
  for (EdgeOverSquare& edge : over_cell_.edges())
    for (std::size_t l = 0; l < levels_m.size() && !rises && obstacle.z_high_m() > levels_m[l]; ++l) {
      const std::span<const double> upper = edge.upper(levels_m[l]);
      const double* limits = &limits_[l * bins_.count];
      for_each_bin(bins_, edge.first_bin(), upper.size(),
                   [&](std::size_t n, std::uint32_t bin) { rises = rises || upper[n] > limits[bin]; });
    }
  return rises;
}

void LookAround::update_limits(const BinRange& range) {
  for (std::uint32_t l = 0; l < place_.patches.layers(); ++l)
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
      const double floor = found_.views.lowest(place_.ceiling_level(l), bin);
      limits_[l * bins_.count + bin] = std::max(floor, slope_of_sine(sine_of_slope(floor) + tolerance_));
    });
}

}  // namespace farlod
