// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "farlod/point.hpp"
#include "farmap/bin_borders.hpp"
#include "package/receiver_patches.hpp"

namespace farlod {

/// The horizons of sample viewpoints: at every corner of the patches' squares, at every level. Each is sampled at the centres of
/// the azimuth bins, as slopes; 0 where nothing rises above the horizontal.
class ViewpointHorizons {
 public:
  /// The borders must outlive it.
  ViewpointHorizons(double cell_edge_m, const ReceiverPatches& patches, const BinBorders& borders);

  static constexpr std::uint32_t all_levels = ~std::uint32_t{0};
  /// Raises the horizons by an edge (cell frame), at the levels whose bits are set.
  void add(const Point3d& a, const Point3d& b, std::uint32_t levels = all_levels);
  /// The horizon of the viewpoint at corner (i, j), counted from the south-west, at a level, in a bin.
  [[nodiscard]] float slope(std::uint32_t i, std::uint32_t j, std::uint32_t level, std::uint32_t bin) const {
    return slopes_[index_of(i, j, bin) + level];
  }
  /// In a bin, for each level the lowest horizon of all viewpoints. Valid until the next call.
  [[nodiscard]] std::span<const float> lowest(std::uint32_t bin);

 private:
  /// The place of the lowest level. The others follow: an edge is drawn at all levels in one pass.
  [[nodiscard]] std::size_t index_of(std::uint32_t i, std::uint32_t j, std::uint32_t bin) const {
    return ((static_cast<std::size_t>(j) * corners_per_edge_ + i) * centres_.size() + bin) * levels_m_.size();
  }
  void add_at(std::uint32_t i, std::uint32_t j, const Point3d& a, const Point3d& b);
  [[nodiscard]] BinRange centres_between(Point2d from, Point2d to) const;

  const BinBorders* borders_;
  std::uint32_t corners_per_edge_;
  double square_edge_m_;
  std::vector<float> levels_m_;
  std::vector<double> drawn_m_;   ///< the levels at which the current edge is drawn; infinite where it is not
  std::vector<Point2d> centres_;  ///< unit vectors through the centres of the bins
  std::vector<float> slopes_, lowest_;
};

}  // namespace farlod
