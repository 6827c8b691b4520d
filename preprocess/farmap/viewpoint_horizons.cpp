// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/viewpoint_horizons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "package/edge_view.hpp"

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

}  // namespace farlod
