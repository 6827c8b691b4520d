// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/occlusion_culler.hpp"

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

OcclusionCuller::OcclusionCuller(const CityHorizon& city, const CellPlace& place, const BinBorders& borders,
                                 const HorizonMapSettings& settings)
    : city_(city),
      place_(place),
      borders_(borders),
      bins_(borders.bins()),
      tolerance_(settings.tolerance),
      weakest_(settings.weakest * settings.tolerance),
      found_{{}, {}, ViewpointHorizons(place.square.high.x, place.patches, borders), {}, {}},
      bounded_slope_(place.patches.layers(), 0.0),
      over_cell_(borders_) {
  found_.hidden.assign(std::size_t{place.patches.layers()} * bins_.count, 0.0F);
  found_.overhang = found_.hidden;
  floors_.assign(found_.hidden.size(), -1.0F);
  weak_over_.resize(found_.hidden.size());
  significant_over_.resize(found_.hidden.size());
  update_limits({0, bins_.count});
}

CullResult OcclusionCuller::run() && {
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

Box2d OcclusionCuller::outline_of(const CityHorizon::Node& node) const {
  return {node.outline.low - place_.corner, node.outline.high - place_.corner};
}

/// The bins in which some place of a box can be seen from some place of the cell, which it does not meet.
BinRange OcclusionCuller::bins_of(const Box2d& box) const {
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
bool OcclusionCuller::hide_node(const CityHorizon::Node& node, double distance_m) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  if (node.z_high_m <= levels_m.front()) return true;
  if (distance_m <= 0.0) return false;
  const BinRange range = bins_of(outline_of(node));
  bool hidden = true;
  for (std::size_t l = 0; l < levels_m.size() && hidden && node.z_high_m > levels_m[l]; ++l) {
    const double slope = slope_at_most(node.z_high_m - levels_m[l], distance_m), *weak_over = &weak_over_[l * bins_.count];
    for_each_bin(bins_, range.first, range.count,
                 [&](std::size_t, std::uint32_t bin) { hidden = hidden && slope <= weak_over[bin]; });
  }
  if (!hidden) return false;
  raise_rows(range, node.z_high_m, distance_m, found_.hidden);
  raise_rows(range, node.z_underside_m, distance_m, found_.overhang);
  return true;
}

/// By what is so high, and nowhere nearer than this.
void OcclusionCuller::raise_rows(const BinRange& range, double z_high_m, double nearest_m, std::vector<float>& rows) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  for (std::size_t l = 0; l < levels_m.size() && z_high_m > levels_m[l]; ++l) {
    const auto slope = static_cast<float>(slope_at_most(z_high_m - levels_m[l], nearest_m));
    float* row = &rows[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) { row[bin] = std::max(row[bin], slope); });
  }
}

void OcclusionCuller::add_leaf(const CityHorizon::Node& leaf, double distance_m) {
  const BinRange range = distance_m > 0.0 ? bins_of(outline_of(leaf)) : BinRange{0, bins_.count};
  update_bounded(range);
  bool drawn = false;
  for (std::uint32_t n = leaf.first_occluder; n < leaf.first_occluder + leaf.occluder_count; ++n) {
    const OccluderEdge& occluder = city_.occluders()[n];
    if (faces_away(occluder) || is_bounded(occluder)) continue;
    const Rise rise = look_at(occluder);
    if (rise == Rise::significant) found_.candidates.push_back(n);
    if (rise == Rise::hidden || !occluder.is_upper()) continue;
    if (rise == Rise::weak) found_.weak.push_back(n);
    const OccluderEdge placed = occluder.from(place_.corner);
    found_.views.add(placed.a, placed.b);
    drawn = true;
  }
  if (drawn) update_limits(range);
}

void OcclusionCuller::update_bounded(const BinRange& range) {
  for (std::size_t l = 0; l < bounded_slope_.size(); ++l) {
    double lowest = std::numeric_limits<double>::infinity();
    const float* row = &found_.hidden[l * bins_.count];
    const double* weak_over = &weak_over_[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
      lowest = std::min({lowest, double{row[bin]}, weak_over[bin]});
    });
    bounded_slope_[l] = lowest;
  }
}

/// Whether an edge can be no silhouette for anybody in the cell: what hides it, or goes on beyond it, is there by its own edges.
bool OcclusionCuller::faces_away(const OccluderEdge& occluder) const {
  const double lowest_m = place_.patches.levels_m().front();
  if (occluder.z_high_m() <= lowest_m) return false;
  const OccluderEdge placed = occluder.from(place_.corner);
  return !may_be_silhouette(placed.a, placed.b, placed.adjacent, placed.role, place_.square, lowest_m, placed.z_high_m());
}

/// Whether an upper border is so low that `hidden` bounds it already, wherever in the leaf at hand it stands. A bound without
/// azimuths is enough to tell for most.
bool OcclusionCuller::is_bounded(const OccluderEdge& occluder) const {
  if (!occluder.is_upper()) return false;
  const OccluderEdge placed = occluder.from(place_.corner);
  Box2d outline;
  outline.add(horizontal(placed.a));
  outline.add(horizontal(placed.b));
  const double nearest_m = distance_m(outline, place_.square), z_high_m = occluder.z_high_m();
  for (std::size_t l = 0; l < bounded_slope_.size() && z_high_m > place_.patches.levels_m()[l]; ++l)
    if (!(slope_at_most(z_high_m - place_.patches.levels_m()[l], nearest_m) <= bounded_slope_[l])) return false;
  return true;
}

OcclusionCuller::Rise OcclusionCuller::look_at(const OccluderEdge& occluder) {
  const OccluderEdge placed = occluder.from(place_.corner);
  over_cell_.look_at(placed.a, placed.b, place_.square);
  const Rise rise = over_cell_.surrounds() ? Rise::significant : rise_of(occluder);
  if (rise != Rise::significant) hide(occluder, occluder.is_upper() ? found_.hidden : found_.overhang);
  return rise;
}

/// How far the occluder at hand may be seen over what stands before it. Unless that is significant, its bounds are kept.
OcclusionCuller::Rise OcclusionCuller::rise_of(const OccluderEdge& occluder) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  bool weak = false, significant = false;
  bounds_.clear();
  for (std::size_t l = 0; l < levels_m.size() && !significant && occluder.z_high_m() > levels_m[l]; ++l) {
    const std::span<const double> upper = over_cell_.high(levels_m[l]);
    const double *weak_over = &weak_over_[l * bins_.count], *significant_over = &significant_over_[l * bins_.count];
    for_each_bin(bins_, over_cell_.first_bin(), upper.size(), [&](std::size_t n, std::uint32_t bin) {
      weak = weak || upper[n] > weak_over[bin];
      significant = significant || upper[n] > significant_over[bin];
    });
    bounds_.insert(bounds_.end(), upper.begin(), upper.end());
  }
  return significant ? Rise::significant : weak ? Rise::weak : Rise::hidden;
}

/// Notes the bounds that are kept of the occluder at hand.
void OcclusionCuller::hide(const OccluderEdge& occluder, std::vector<float>& rows) {
  const std::vector<float>& levels_m = place_.patches.levels_m();
  const double* bound = bounds_.data();
  for (std::size_t l = 0; l < levels_m.size() && occluder.z_high_m() > levels_m[l]; ++l, bound += over_cell_.bin_count()) {
    float* row = &rows[l * bins_.count];
    for_each_bin(bins_, over_cell_.first_bin(), over_cell_.bin_count(),
                 [&](std::size_t n, std::uint32_t bin) { row[bin] = std::max(row[bin], static_cast<float>(bound[n])); });
  }
}

void OcclusionCuller::update_limits(const BinRange& range) {
  for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
    const std::span<const float> floors = found_.views.lowest(bin);
    for (std::uint32_t l = 0; l < place_.patches.layers(); ++l) {
      const float floor = floors[place_.ceiling_level(l)];
      const std::size_t place = std::size_t{l} * bins_.count + bin;
      if (floor == floors_[place]) continue;
      floors_[place] = floor;
      const double sine = sine_of_slope(floor);
      weak_over_[place] = std::max<double>(floor, slope_of_sine(sine + weakest_));
      significant_over_[place] = std::max<double>(floor, slope_of_sine(sine + tolerance_));
    }
  });
}

}  // namespace farlod
