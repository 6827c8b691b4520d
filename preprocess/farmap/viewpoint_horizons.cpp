// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/viewpoint_horizons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "farlod/horizon/edge_view.hpp"

namespace farlod {

ViewpointHorizons::ViewpointHorizons(double cell_edge_m, const ReceiverPatches& patches, const AzimuthBins& bins)
    : bins_(bins),
      corners_per_edge_(patches.squares_per_edge() + 1),
      square_edge_m_(cell_edge_m / patches.squares_per_edge()),
      levels_m_(patches.levels_m()),
      slopes_(static_cast<std::size_t>(corners_per_edge_) * corners_per_edge_ * levels_m_.size() * bins.count, 0.0F) {
  for (std::uint32_t k = 0; k < bins.count; ++k) {
    const double azimuth = (k + 0.5) * bins.width_rad();
    middles_.push_back({std::cos(azimuth), std::sin(azimuth)});
  }
}

void ViewpointHorizons::add(const Point3d& a, const Point3d& b, std::uint32_t levels) {
  for (std::uint32_t j = 0; j < corners_per_edge_; ++j)
    for (std::uint32_t i = 0; i < corners_per_edge_; ++i) add_at(i, j, a, b, levels);
}

void ViewpointHorizons::add_at(std::uint32_t i, std::uint32_t j, const Point3d& a, const Point3d& b, std::uint32_t levels) {
  const Point3d eye{i * square_edge_m_, j * square_edge_m_, 0.0};
  EdgeView view{a - eye, b - eye};
  if (view.turn() == 0.0) return;
  if (view.turn() < 0.0) std::swap(view.a, view.b);
  const double from = std::atan2(view.a.y, view.a.x);
  double to = std::atan2(view.b.y, view.b.x);
  if (to < from) to += 2.0 * std::numbers::pi;
  // The bins whose middles lie between
  const auto first = static_cast<std::int64_t>(std::ceil(from / bins_.width_rad() - 0.5));
  const auto last = static_cast<std::int64_t>(std::floor(to / bins_.width_rad() - 0.5));
  const SlopePlane plane = view.plane();
  const double along_x = view.b.x - view.a.x, along_y = view.b.y - view.a.y, turn = view.turn();
  const double z_high_m = std::max(a.z, b.z);
  for (std::int64_t n = first; n <= last; ++n) {
    const std::uint32_t bin = bins_.wrapped(n);
    const Point2d u = middles_[bin];
    const double rise = plane.slope(u), per_metre = (u.x * along_y - u.y * along_x) / turn;
    for (std::uint32_t level = 0; level < levels_m_.size() && levels_m_[level] < z_high_m; ++level) {
      if (((levels >> level) & 1U) == 0) continue;
      float& slope = slopes_[place(i, j, level) + bin];
      slope = std::max(slope, static_cast<float>(rise - levels_m_[level] * per_metre));
    }
  }
}

float ViewpointHorizons::lowest(std::uint32_t level, std::uint32_t bin) const {
  float slope = std::numeric_limits<float>::infinity();
  for (std::uint32_t j = 0; j < corners_per_edge_; ++j)
    for (std::uint32_t i = 0; i < corners_per_edge_; ++i) slope = std::min(slope, slopes_[place(i, j, level) + bin]);
  return slope;
}

}  // namespace farlod
