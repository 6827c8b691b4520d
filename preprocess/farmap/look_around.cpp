// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/look_around.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "farlod/horizon/edge_facing.hpp"

namespace farlod {
namespace {

/// Between two boxes in the plane; 0 where they meet.
double distance_m(const Box2d& a, const Box2d& b) {
  const double x = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
  const double y = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
  return std::sqrt(x * x + y * y);
}

/// What rises so high, nowhere nearer than this, stays below this slope.
double slope_at_most(double rise_m, double nearest_m) { return rise_m / nearest_m * (1.0 + bound_rounding) + bound_rounding; }

struct Waiting {
  double distance_m;
  std::uint32_t node;
  bool operator<(const Waiting& o) const { return std::pair(distance_m, node) > std::pair(o.distance_m, o.node); }
};

}  // namespace

LookAround::LookAround(const CityHorizon& city, const CellPlace& place, const BinBorders& borders,
                       const HorizonMapSettings& settings)
    : city_(city),
      place_(place),
      borders_(borders),
      bins_(borders.bins()),
      tolerance_(settings.tolerance),
      faintest_(settings.faintest * settings.tolerance),
      found_{{}, {}, ViewpointHorizons(place.square.high.x, place.patches, borders), {}, {}},
      settled_(place.patches.layers(), 0.0),
      over_cell_(borders_) {
  found_.hidden.assign(std::size_t{place.patches.layers()} * bins_.count, 0.0F);
  found_.overhang = found_.hidden;
  floors_.assign(found_.hidden.size(), -1.0F);
  faint_over_.resize(found_.hidden.size());
  notable_over_.resize(found_.hidden.size());
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
BinRange LookAround::bins_of(const Box2d& box) const {
  // The difference of the two boxes is a box without the origin: its corners bound the azimuths, within half a turn
  const Box2d difference{box.low - place_.square.high, box.high - place_.square.low};
  Point2d from = difference.low, to = from;
  for (const Point2d d :
       {Point2d{difference.high.x, difference.low.y}, difference.high, Point2d{difference.low.x, difference.high.y}}) {
    if (from.x * d.y < from.y * d.x) from = d;
    if (to.x * d.y > to.y * d.x) to = d;
  }
  return borders_.between(turned(from, -bound_rounding), turned(to, bound_rounding));
}

/// When all of a node is surely below what stands before it, its bound is noted, and it is done.
bool LookAround::hide_node(const CityHorizon::Node& node, double distance_m) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  if (node.z_high_m <= levels_m.front()) return true;
  if (distance_m <= 0.0) return false;
  const BinRange range = bins_of(outline_of(node));
  bool hidden = true;
  for (std::size_t l = 0; l < levels_m.size() && hidden && node.z_high_m > levels_m[l]; ++l) {
    const double slope = slope_at_most(node.z_high_m - levels_m[l], distance_m), *faint_over = &faint_over_[l * bins_.count];
    for_each_bin(bins_, range.first, range.count,
                 [&](std::size_t, std::uint32_t bin) { hidden = hidden && slope <= faint_over[bin]; });
  }
  if (!hidden) return false;
  raise_rows(range, node.z_high_m, distance_m, found_.hidden);
  raise_rows(range, node.z_underside_m, distance_m, found_.overhang);
  return true;
}

/// By what is so high, and nowhere nearer than this.
void LookAround::raise_rows(const BinRange& range, double z_high_m, double nearest_m, std::vector<float>& rows) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  for (std::size_t l = 0; l < levels_m.size() && z_high_m > levels_m[l]; ++l) {
    const auto slope = static_cast<float>(slope_at_most(z_high_m - levels_m[l], nearest_m));
    float* row = &rows[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) { row[bin] = std::max(row[bin], slope); });
  }
}

void LookAround::add_leaf(const CityHorizon::Node& leaf, double distance_m) {
  const BinRange range = distance_m > 0.0 ? bins_of(outline_of(leaf)) : BinRange{0, bins_.count};
  remember_what_is_settled(range);
  bool drawn = false;
  for (std::uint32_t n = leaf.first_obstacle; n < leaf.first_obstacle + leaf.obstacle_count; ++n) {
    const Obstacle& obstacle = city_.obstacles()[n];
    if (faces_away(obstacle) || is_settled(obstacle)) continue;
    const Rise rise = look_at(obstacle);
    if (rise == Rise::notable) found_.candidates.push_back(n);
    if (rise == Rise::hidden || !obstacle.is_upper()) continue;
    if (rise == Rise::faint) found_.faint.push_back(n);
    const Obstacle placed = obstacle.from(place_.corner);
    found_.views.add(placed.a, placed.b);
    drawn = true;
  }
  if (drawn) update_limits(range);
}

void LookAround::remember_what_is_settled(const BinRange& range) {
  for (std::size_t l = 0; l < settled_.size(); ++l) {
    double lowest = std::numeric_limits<double>::infinity();
    const float* row = &found_.hidden[l * bins_.count];
    const double* faint_over = &faint_over_[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
      lowest = std::min({lowest, double{row[bin]}, faint_over[bin]});
    });
    settled_[l] = lowest;
  }
}

/// Whether an edge can be no silhouette for anybody in the cell: what hides it, or goes on beyond it, is there by its own edges.
bool LookAround::faces_away(const Obstacle& obstacle) const {
  const double lowest_m = place_.patches.levels_m().front();
  if (obstacle.z_high_m() <= lowest_m) return false;
  const Obstacle placed = obstacle.from(place_.corner);
  return !may_be_silhouette(placed.a, placed.b, placed.rises, placed.role, place_.square, lowest_m, placed.z_high_m());
}

/// Whether an upper border is so low that `hidden` bounds it already, wherever in the leaf at hand it stands. A bound without
/// azimuths is enough to tell for most.
bool LookAround::is_settled(const Obstacle& obstacle) const {
  if (!obstacle.is_upper()) return false;
  const Obstacle placed = obstacle.from(place_.corner);
  Box2d outline;
  outline.add(horizontal(placed.a));
  outline.add(horizontal(placed.b));
  const double nearest_m = distance_m(outline, place_.square), z_high_m = obstacle.z_high_m();
  for (std::size_t l = 0; l < settled_.size() && z_high_m > place_.patches.levels_m()[l]; ++l)
    if (!(slope_at_most(z_high_m - place_.patches.levels_m()[l], nearest_m) <= settled_[l])) return false;
  return true;
}

LookAround::Rise LookAround::look_at(const Obstacle& obstacle) {
  const Obstacle placed = obstacle.from(place_.corner);
  over_cell_.look_at(placed.a, placed.b, place_.square);
  const Rise rise = over_cell_.surrounds() ? Rise::notable : rise_of(obstacle);
  if (rise != Rise::notable) hide(obstacle, obstacle.is_upper() ? found_.hidden : found_.overhang);
  return rise;
}

/// How far the obstacle at hand may be seen over what stands before it. Unless that is notable, its bounds are kept.
LookAround::Rise LookAround::rise_of(const Obstacle& obstacle) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  bool faint = false, notable = false;
  bounds_.clear();
  for (std::size_t l = 0; l < levels_m.size() && !notable && obstacle.z_high_m() > levels_m[l]; ++l) {
    const std::span<const double> upper = over_cell_.upper(levels_m[l]);
    const double *faint_over = &faint_over_[l * bins_.count], *notable_over = &notable_over_[l * bins_.count];
    for_each_bin(bins_, over_cell_.first_bin(), upper.size(), [&](std::size_t n, std::uint32_t bin) {
      faint = faint || upper[n] > faint_over[bin];
      notable = notable || upper[n] > notable_over[bin];
    });
    bounds_.insert(bounds_.end(), upper.begin(), upper.end());
  }
  return notable ? Rise::notable : faint ? Rise::faint : Rise::hidden;
}

/// Notes the bounds that are kept of the obstacle at hand.
void LookAround::hide(const Obstacle& obstacle, std::vector<float>& rows) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  const double* bound = bounds_.data();
  for (std::size_t l = 0; l < levels_m.size() && obstacle.z_high_m() > levels_m[l]; ++l, bound += over_cell_.bin_count()) {
    float* row = &rows[l * bins_.count];
    for_each_bin(bins_, over_cell_.first_bin(), over_cell_.bin_count(),
                 [&](std::size_t n, std::uint32_t bin) { row[bin] = std::max(row[bin], static_cast<float>(bound[n])); });
  }
}

void LookAround::update_limits(const BinRange& range) {
  for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
    const std::span<const float> floors = found_.views.lowest(bin);
    for (std::uint32_t l = 0; l < place_.patches.layers(); ++l) {
      const float floor = floors[place_.ceiling_level(l)];
      const std::size_t place = std::size_t{l} * bins_.count + bin;
      if (floor == floors_[place]) continue;
      floors_[place] = floor;
      const double sine = sine_of_slope(floor);
      faint_over_[place] = std::max<double>(floor, slope_of_sine(sine + faintest_));
      notable_over_[place] = std::max<double>(floor, slope_of_sine(sine + tolerance_));
    }
  });
}

}  // namespace farlod
