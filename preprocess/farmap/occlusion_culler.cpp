// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/occlusion_culler.hpp"

#include <queue>
#include <utility>

#include "base/paging/memory_bound.hpp"
#include "city/geometry.hpp"
#include "package/horizon_edge.hpp"

namespace farlod {

ViewpointHorizons::ViewpointHorizons(double cell_edge_m, const ReceiverPatches& patches, const BinBorders& borders)
    : borders_(&borders),
      corners_per_edge_(patches.squares_per_edge() + 1),
      square_edge_m_(cell_edge_m / patches.squares_per_edge()),
      levels_m_(patches.levels_m()),
      slopes_(static_cast<std::size_t>(corners_per_edge_) * corners_per_edge_ * levels_m_.size() * borders.bins().count, 0.0F) {
  for (std::uint32_t k = 0; k < borders.bins().count; ++k) {
    const double azimuth = (k + 0.5) * borders.bins().width_rad();
    centres_.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
}

void ViewpointHorizons::add(const Point3d& a, const Point3d& b, std::uint32_t levels) {
  // At levels that are as high as the edge nothing rises; at those that are not wanted, infinite heights make nothing rise
  drawn_m_.clear();
  for (std::uint32_t level = 0; level < levels_m_.size() && levels_m_[level] < std::max(a.z, b.z); ++level)
    drawn_m_.push_back(((levels >> level) & 1U) != 0 ? levels_m_[level] : std::numeric_limits<double>::infinity());
  for (std::uint32_t j = 0; j < corners_per_edge_; ++j)
    for (std::uint32_t i = 0; i < corners_per_edge_; ++i) add_at(i, j, a, b);
}

/// The bins whose centres lie between two directions, counter-clockwise.
BinRange ViewpointHorizons::centres_between(Point2d from, Point2d to) const {
  const AzimuthBins& bins = borders_->bins();
  // Positive where a direction lies counter-clockwise of the bin's centre
  const auto beyond_centre = [&](std::int64_t bin, Point2d d) {
    const Point2d centre = centres_[wrapped_once(bins, bin)];
    return centre.x * d.y - centre.y * d.x;
  };
  // Leave out the first bin when the range begins beyond its centre, the last one when the range ends before it
  std::int64_t first = borders_->bin_of(from), last = borders_->bin_of(to);
  if (beyond_centre(first, from) > 0.0) ++first;
  if (beyond_centre(last, to) < 0.0) --last;
  return {first, wrapped_once(bins, last - first + 1)};
}

void ViewpointHorizons::add_at(std::uint32_t i, std::uint32_t j, const Point3d& a, const Point3d& b) {
  // See the edge from the viewpoint, at height 0, running counter-clockwise
  const Point3d eye{i * square_edge_m_, j * square_edge_m_, 0.0};
  EdgeView view{a - eye, b - eye};
  if (view.turn() == 0.0) return;
  if (view.turn() < 0.0) std::swap(view.a, view.b);
  const BinRange range = centres_between(horizontal(view.a), horizontal(view.b));
  if (range.count == 0) return;
  // At the azimuth u, the edge is |a × b| / (u × (b − a)) away, so that a rise of 1 m of the eye costs `per_metre` of slope:
  // slope(u, z) = plane.slope(u) − z · per_metre(u)
  const SlopePlane plane = view.plane();
  const Point2d along = horizontal(view.b) - horizontal(view.a);
  const double turn = view.turn();
  for_each_bin(borders_->bins(), range.first, range.count, [&](std::size_t, std::uint32_t bin) {
    const Point2d u = centres_[bin];
    const double slope_at_0 = plane.slope(u), per_metre = (u.x * along.y - u.y * along.x) / turn;
    float* slopes = &slopes_[index_of(i, j, bin)];
    for (std::size_t level = 0; level < drawn_m_.size(); ++level)
      slopes[level] = std::max(slopes[level], static_cast<float>(slope_at_0 - drawn_m_[level] * per_metre));
  });
}

std::span<const float> ViewpointHorizons::lowest(std::uint32_t bin) {
  lowest_.assign(levels_m_.size(), std::numeric_limits<float>::infinity());
  for (std::uint32_t j = 0; j < corners_per_edge_; ++j)
    for (std::uint32_t i = 0; i < corners_per_edge_; ++i) {
      const float* slopes = &slopes_[index_of(i, j, bin)];
      for (std::size_t level = 0; level < lowest_.size(); ++level) lowest_[level] = std::min(lowest_[level], slopes[level]);
    }
  return lowest_;
}

namespace {

/// An upper bound of the slope of what rises so high and is nowhere nearer than this.
double slope_at_most(double rise_m, double nearest_m) { return rise_m / nearest_m * (1.0 + bound_rounding) + bound_rounding; }

/// A node of the tree that waits to be visited. In a priority queue, the nearest comes first, equal ones in a fixed order.
struct QueuedNode {
  double distance_m;
  std::uint32_t node;
  bool operator<(const QueuedNode& o) const { return std::pair(distance_m, node) > std::pair(o.distance_m, o.node); }
};

}  // namespace

OcclusionCuller::OcclusionCuller(const CityHorizon& city, const ReceiverCell& cell, const BinBorders& borders,
                                 const HorizonMapSettings& settings)
    : city_(city),
      cell_(cell),
      borders_(borders),
      bins_(borders.bins()),
      result_{{}, {}, ViewpointHorizons(cell.square.high.x, cell.patches, borders), {}, {}},
      of_city_{settings.weak_share * settings.tolerance, settings.tolerance},
      of_far_terrain_{std::min(settings.weak_far_terrain, settings.tolerance),
                      std::min(settings.far_terrain_tolerance, settings.tolerance)},
      leaf_bound_(cell.patches.layers(), 0.0),
      edge_(borders_) {
  result_.high.assign(std::size_t{cell.patches.layers()} * bins_.count, 0.0F);
  result_.overhang = result_.high;
  lowest_horizon_.assign(result_.high.size(), -1.0F);
  for (Thresholds* thresholds : {&of_city_, &of_far_terrain_}) {
    thresholds->weak_above.resize(result_.high.size());
    thresholds->significant_above.resize(result_.high.size());
  }
  update_thresholds({0, bins_.count});
}

CullResult OcclusionCuller::run() && {
  // Visit the tree of boxes from near to far: what is nearer hides what is farther
  std::priority_queue<QueuedNode> queue;
  const auto push = [&](std::uint32_t n) {
    if (!city_.nodes()[n].outline.empty()) queue.push({distance_m(outline_of(city_.nodes()[n]), cell_.square), n});
  };
  if (!city_.nodes().empty()) push(0);
  for (std::size_t visited = 0; !queue.empty(); ++visited) {
    constexpr std::size_t visits_between_looks = 64;
    if (visited % visits_between_looks == 0) MemoryBound::look_now();
    const auto [distance_m, n] = queue.top();
    queue.pop();
    const CityHorizon::Node& node = city_.nodes()[n];
    is_far_terrain_ = node.cell == beyond_grid;
    // Cull a node as a whole, descend into it, or visit the occluders of its cell, unless that is near
    if (cull_node(node, distance_m)) continue;
    if (node.children != 0) {
      push(node.children);
      push(node.children + 1);
    } else if (!cell_.near.contains(node.cell)) {
      visit_leaf(node, distance_m);
    }
  }
  return std::move(result_);
}

Box2d OcclusionCuller::outline_of(const CityHorizon::Node& node) const {
  return {node.outline.low - cell_.corner, node.outline.high - cell_.corner};
}

/// The bins in which some place of a box can be seen from some place of the cell, which it does not meet.
BinRange OcclusionCuller::bins_of(const Box2d& box) const {
  // The difference of the two boxes is a box without the origin: its corners bound the azimuths, within half a turn
  const Box2d difference{box.low - cell_.square.high, box.high - cell_.square.low};
  Point2d from = difference.low, to = from;
  for (const Point2d d :
       {Point2d{difference.high.x, difference.low.y}, difference.high, Point2d{difference.low.x, difference.high.y}}) {
    if (from.x * d.y < from.y * d.x) from = d;
    if (to.x * d.y > to.y * d.x) to = d;
  }
  return borders_.between(turned(from, -bound_rounding), turned(to, bound_rounding));
}

/// Culls a node when its whole box stays below Thresholds::weak_above, and returns whether it did.
bool OcclusionCuller::cull_node(const CityHorizon::Node& node, double distance_m) {
  const std::vector<float>& levels_m = cell_.patches.levels_m();
  // What does not rise above the lowest receiver hides nothing; what meets the cell cannot be bounded
  if (node.z_high_m <= levels_m.front()) return true;
  if (distance_m <= 0.0) return false;
  // Compare the slope of the box's top at its nearest place, layer by layer, in all bins that the box touches
  const BinRange range = bins_of(outline_of(node));
  bool culled = true;
  for (std::size_t l = 0; l < levels_m.size() && culled && node.z_high_m > levels_m[l]; ++l) {
    const double slope = slope_at_most(node.z_high_m - levels_m[l], distance_m);
    const double* weak = &thresholds().weak_above[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) { culled = culled && slope <= weak[bin]; });
  }
  if (!culled) return false;
  // Keep that slope as the bound of all that is in the box
  raise_by_box(range, node.z_high_m, distance_m, result_.high);
  raise_by_box(range, node.z_underside_m, distance_m, result_.overhang);
  return true;
}

/// Raises rows to the bound of a box that is so high and nowhere nearer than this.
void OcclusionCuller::raise_by_box(const BinRange& range, double z_high_m, double nearest_m, std::vector<float>& rows) {
  const std::vector<float>& levels_m = cell_.patches.levels_m();
  for (std::size_t l = 0; l < levels_m.size() && z_high_m > levels_m[l]; ++l) {
    const auto slope = static_cast<float>(slope_at_most(z_high_m - levels_m[l], nearest_m));
    float* row = &rows[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) { row[bin] = std::max(row[bin], slope); });
  }
}

/// Classifies the occluders of a far cell, and draws those that count into the horizons of the viewpoints.
void OcclusionCuller::visit_leaf(const CityHorizon::Node& leaf, double distance_m) {
  const BinRange range = distance_m > 0.0 ? bins_of(outline_of(leaf)) : BinRange{0, bins_.count};
  update_leaf_bound(range);
  bool drawn = false;
  for (std::uint32_t n = leaf.first_occluder; n < leaf.first_occluder + leaf.occluder_count; ++n) {
    const OccluderEdge& occluder = city_.occluders()[n];
    // Skip what is no silhouette, and what is bounded already
    if (faces_away(occluder) || is_below_leaf_bound(occluder)) continue;
    const Visibility visibility = classify(occluder);
    if (visibility == Visibility::significant) result_.candidates.push_back(n);
    // Only upper borders raise horizons
    if (visibility == Visibility::hidden || !occluder.is_upper()) continue;
    if (visibility == Visibility::weak) result_.weak.push_back(n);
    const OccluderEdge placed = occluder.from(cell_.corner);
    result_.viewpoints.add(placed.a, placed.b);
    drawn = true;
  }
  // Once for the whole leaf: its occluders do not cull each other
  if (drawn) update_thresholds(range);
}

/// Whether an edge can be no silhouette for anybody in the cell: what hides it, or goes on beyond it, is there by its own edges.
bool OcclusionCuller::faces_away(const OccluderEdge& occluder) const {
  const double lowest_m = cell_.patches.levels_m().front();
  if (occluder.z_high_m() <= lowest_m) return false;
  const OccluderEdge placed = occluder.from(cell_.corner);
  return !may_be_silhouette(placed.a, placed.b, placed.adjacent, placed.role, cell_.square, lowest_m, placed.z_high_m());
}

/// Finds for each layer the largest slope that is culled, and bounded by `high` already, in all bins of the leaf.
void OcclusionCuller::update_leaf_bound(const BinRange& range) {
  for (std::size_t l = 0; l < leaf_bound_.size(); ++l) {
    double lowest = std::numeric_limits<double>::infinity();
    const float* row = &result_.high[l * bins_.count];
    const double* weak = &thresholds().weak_above[l * bins_.count];
    for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
      lowest = std::min({lowest, double{row[bin]}, weak[bin]});
    });
    leaf_bound_[l] = lowest;
  }
}

/// Whether an upper border is so low that `high` bounds it already, wherever in the leaf it stands. Most are: its azimuths need
/// not be found.
bool OcclusionCuller::is_below_leaf_bound(const OccluderEdge& occluder) const {
  if (!occluder.is_upper()) return false;
  const OccluderEdge placed = occluder.from(cell_.corner);
  Box2d outline;
  outline.add(horizontal(placed.a));
  outline.add(horizontal(placed.b));
  const double nearest_m = distance_m(outline, cell_.square), z_high_m = occluder.z_high_m();
  for (std::size_t l = 0; l < leaf_bound_.size() && z_high_m > cell_.patches.levels_m()[l]; ++l)
    if (!(slope_at_most(z_high_m - cell_.patches.levels_m()[l], nearest_m) <= leaf_bound_[l])) return false;
  return true;
}

/// Makes an occluder the current one. Unless it is significant, its bounds are kept.
OcclusionCuller::Visibility OcclusionCuller::classify(const OccluderEdge& occluder) {
  const OccluderEdge placed = occluder.from(cell_.corner);
  edge_.set_edge(placed.a, placed.b, cell_.square);
  const Visibility visibility = edge_.is_unbounded() ? Visibility::significant : visibility_of(occluder);
  if (visibility != Visibility::significant) raise_by_bounds(occluder, occluder.is_upper() ? result_.high : result_.overhang);
  return visibility;
}

/// Compares the upper bounds of the current occluder with the thresholds, level by level, and remembers them.
OcclusionCuller::Visibility OcclusionCuller::visibility_of(const OccluderEdge& occluder) {
  const std::vector<float>& levels_m = cell_.patches.levels_m();
  bool weak = false, significant = false;
  bounds_.clear();
  for (std::size_t l = 0; l < levels_m.size() && !significant && occluder.z_high_m() > levels_m[l]; ++l) {
    const std::span<const double> high = edge_.high(levels_m[l]);
    const double *weak_above = &thresholds().weak_above[l * bins_.count],
                 *significant_above = &thresholds().significant_above[l * bins_.count];
    for_each_bin(bins_, edge_.first_bin(), high.size(), [&](std::size_t n, std::uint32_t bin) {
      weak = weak || high[n] > weak_above[bin];
      significant = significant || high[n] > significant_above[bin];
    });
    bounds_.insert(bounds_.end(), high.begin(), high.end());
  }
  return significant ? Visibility::significant : weak ? Visibility::weak : Visibility::hidden;
}

/// Raises rows to the remembered bounds of the current occluder.
void OcclusionCuller::raise_by_bounds(const OccluderEdge& occluder, std::vector<float>& rows) {
  const std::vector<float>& levels_m = cell_.patches.levels_m();
  const double* bound = bounds_.data();
  for (std::size_t l = 0; l < levels_m.size() && occluder.z_high_m() > levels_m[l]; ++l, bound += edge_.bin_count()) {
    float* row = &rows[l * bins_.count];
    for_each_bin(bins_, edge_.first_bin(), edge_.bin_count(),
                 [&](std::size_t n, std::uint32_t bin) { row[bin] = std::max(row[bin], static_cast<float>(bound[n])); });
  }
}

void OcclusionCuller::Thresholds::raise(std::size_t index, float lowest_horizon) {
  const double sine = sine_of_slope(lowest_horizon);
  weak_above[index] = std::max<double>(lowest_horizon, slope_of_sine(sine + weak_tolerance));
  significant_above[index] = std::max<double>(lowest_horizon, slope_of_sine(sine + tolerance));
}

/// Adds the tolerances to the lowest horizon of the viewpoints, where that has risen. Of a layer, the viewpoints at its ceiling
/// count: they see the lowest horizon.
void OcclusionCuller::update_thresholds(const BinRange& range) {
  for_each_bin(bins_, range.first, range.count, [&](std::size_t, std::uint32_t bin) {
    const std::span<const float> lowest_of_level = result_.viewpoints.lowest(bin);
    for (std::uint32_t l = 0; l < cell_.patches.layers(); ++l) {
      const float lowest = lowest_of_level[cell_.ceiling_level(l)];
      const std::size_t index = std::size_t{l} * bins_.count + bin;
      if (lowest == lowest_horizon_[index]) continue;
      lowest_horizon_[index] = lowest;
      of_city_.raise(index, lowest);
      if (city_.has_far_terrain()) of_far_terrain_.raise(index, lowest);
    }
  });
}

}  // namespace farlod
