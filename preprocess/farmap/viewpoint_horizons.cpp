// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/viewpoint_horizons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "farlod/horizon/edge_view.hpp"

namespace farlod {

ViewpointHorizons::ViewpointHorizons(double cell_edge_m, const ReceiverPatches& patches, const BinBorders& borders)
    : borders_(&borders),
      corners_per_edge_(patches.squares_per_edge() + 1),
      square_edge_m_(cell_edge_m / patches.squares_per_edge()),
      levels_m_(patches.levels_m()),
      slopes_(static_cast<std::size_t>(corners_per_edge_) * corners_per_edge_ * levels_m_.size() * borders.bins().count, 0.0F) {
  for (std::uint32_t k = 0; k < borders.bins().count; ++k) {
    const double azimuth = (k + 0.5) * borders.bins().width_rad();
    middles_.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
}

void ViewpointHorizons::add(const Point3d& a, const Point3d& b, std::uint32_t levels) {
  shown_m_.clear();
  for (std::uint32_t level = 0; level < levels_m_.size() && levels_m_[level] < std::max(a.z, b.z); ++level)
    shown_m_.push_back(((levels >> level) & 1U) != 0 ? levels_m_[level] : std::numeric_limits<double>::infinity());
  for (std::uint32_t j = 0; j < corners_per_edge_; ++j)
    for (std::uint32_t i = 0; i < corners_per_edge_; ++i) add_at(i, j, a, b);
}

/// The bins whose middles lie between two directions, counter-clockwise.
BinRange ViewpointHorizons::middles_between(Point2d from, Point2d to) const {
  const AzimuthBins& bins = borders_->bins();
  const auto passed_middle = [&](std::int64_t bin, Point2d d) {
    const Point2d middle = middles_[wrapped_once(bins, bin)];
    return middle.x * d.y - middle.y * d.x;
  };
  std::int64_t first = borders_->bin_of(from), last = borders_->bin_of(to);
  if (passed_middle(first, from) > 0.0) ++first;
  if (passed_middle(last, to) < 0.0) --last;
  return {first, wrapped_once(bins, last - first + 1)};
}

void ViewpointHorizons::add_at(std::uint32_t i, std::uint32_t j, const Point3d& a, const Point3d& b) {
  const Point3d eye{i * square_edge_m_, j * square_edge_m_, 0.0};
  EdgeView view{a - eye, b - eye};
  if (view.turn() == 0.0) return;
  if (view.turn() < 0.0) std::swap(view.a, view.b);
  const BinRange middles = middles_between(horizontal(view.a), horizontal(view.b));
  if (middles.count == 0) return;
  const SlopePlane plane = view.plane();
  const Point2d along = horizontal(view.b) - horizontal(view.a);
  const double turn = view.turn();
  for_each_bin(borders_->bins(), middles.first, middles.count, [&](std::size_t, std::uint32_t bin) {
    const Point2d u = middles_[bin];
    const double rise = plane.slope(u), per_metre = (u.x * along.y - u.y * along.x) / turn;
    float* slopes = &slopes_[place(i, j, bin)];
    for (std::size_t level = 0; level < shown_m_.size(); ++level)
      slopes[level] = std::max(slopes[level], static_cast<float>(rise - shown_m_[level] * per_metre));
  });
}

std::span<const float> ViewpointHorizons::lowest(std::uint32_t bin) {
  lowest_.assign(levels_m_.size(), std::numeric_limits<float>::infinity());
  for (std::uint32_t j = 0; j < corners_per_edge_; ++j)
    for (std::uint32_t i = 0; i < corners_per_edge_; ++i) {
      const float* slopes = &slopes_[place(i, j, bin)];
      for (std::size_t level = 0; level < lowest_.size(); ++level) lowest_[level] = std::min(lowest_[level], slopes[level]);
    }
  return lowest_;
}

}  // namespace farlod
