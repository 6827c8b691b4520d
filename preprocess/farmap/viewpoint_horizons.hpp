// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/far_map/receiver_patches.hpp"
#include "farlod/horizon/azimuth.hpp"
#include "farlod/point.hpp"

namespace farlod {

/// The horizons of sample viewpoints: at every corner of the patches' squares, at every level. Each is sampled at the middles of
/// the azimuth bins, as slopes; 0 where nothing rises above the horizontal.
class ViewpointHorizons {
 public:
  ViewpointHorizons(double cell_edge_m, const ReceiverPatches& patches, const AzimuthBins& bins);

  static constexpr std::uint32_t all_levels = ~std::uint32_t{0};
  /// Raises the horizons by an edge (cell frame), at the levels whose bits are set.
  void add(const Point3d& a, const Point3d& b, std::uint32_t levels = all_levels);
  /// The horizon of the viewpoint at corner (i, j), counted from the south-west, at a level.
  [[nodiscard]] std::span<const float> at(std::uint32_t i, std::uint32_t j, std::uint32_t level) const {
    return std::span(slopes_).subspan(place(i, j, level), bins_.count);
  }
  /// In a bin, the lowest horizon of all viewpoints of a level.
  [[nodiscard]] float lowest(std::uint32_t level, std::uint32_t bin) const;

 private:
  [[nodiscard]] std::size_t place(std::uint32_t i, std::uint32_t j, std::uint32_t level) const {
    return ((static_cast<std::size_t>(j) * corners_per_edge_ + i) * levels_m_.size() + level) * bins_.count;
  }
  void add_at(std::uint32_t i, std::uint32_t j, const Point3d& a, const Point3d& b, std::uint32_t levels);

  AzimuthBins bins_;
  std::uint32_t corners_per_edge_;
  double square_edge_m_;
  std::vector<float> levels_m_;
  std::vector<Point2d> middles_;  ///< unit vectors through the middles of the bins
  std::vector<float> slopes_;
};

}  // namespace farlod
