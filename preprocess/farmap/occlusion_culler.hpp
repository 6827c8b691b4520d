// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "farmap/bin_borders.hpp"
#include "farmap/city_horizon.hpp"
#include "farmap/edge_over_square.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "package/far_map.hpp"

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

/// A cell whose far map is baked: where it lies in the frame of CityHorizon, and where its receivers may be.
struct ReceiverCell {
  Point2d corner;
  CellRange near;
  Box2d square;  ///< cell frame
  ReceiverPatches patches;

  /// The number of the level that bounds a layer from above. The uppermost layer has no lid: its floor stands in.
  [[nodiscard]] std::uint32_t ceiling_level(std::uint32_t layer) const { return std::min(layer + 1, patches.layers() - 1); }
};

/// The sine of an elevation, from its tangent.
[[nodiscard]] inline double sine_of_slope(double slope) { return slope / std::sqrt(1.0 + slope * slope); }
/// And back; infinite for sines that no slope reaches.
[[nodiscard]] inline double slope_of_sine(double sine) {
  return sine < 1.0 ? sine / std::sqrt(1.0 - sine * sine) : std::numeric_limits<double>::infinity();
}

/// The far city of a cell, divided into what may be explicit and what is only bounded.
///   (1) each upper border outside of the neighborhood is a candidate, or lies below `high` from all over the cell
///   (2) an upper border that is no candidate rises by no more than the tolerance over what the viewpoints see of the nearer city
///   (3) one that is not weak either rises by no more than HorizonMapSettings::weak_share of the tolerance
///       (the far terrain has tolerances of its own for both)
///   (4) each lower border outside of the neighborhood is a candidate, or lies likewise below `overhang`
struct CullResult {
  std::vector<std::uint32_t> candidates;  ///< numbers of occluders, from near to far
  std::vector<std::uint32_t> weak;        ///< likewise: upper borders that are hidden, but count for the estimate
  ViewpointHorizons viewpoints;           ///< of the upper borders among the candidates, and of the weak ones
  std::vector<float> high, overhang;      ///< slopes that bound what is hidden: a row of azimuth bins for each layer
};

/// Occlusion culling for one cell: visits the far city from near to far, and culls what the nearer city hides nearly everywhere.
/// Whole subtrees of CityHorizon are culled at once.
class OcclusionCuller {
 public:
  /// All must outlive it.
  OcclusionCuller(const CityHorizon& city, const ReceiverCell& cell, const BinBorders& borders,
                  const HorizonMapSettings& settings);

  [[nodiscard]] CullResult run() &&;

 private:
  /// Rows as in CullResult::high: the slopes above which an occluder is weak or significant, which are the lowest horizon of all
  /// viewpoints so far and two tolerances (sines of elevations) on top of it.
  struct Thresholds {
    double weak_tolerance, tolerance;
    std::vector<double> weak_above = {}, significant_above = {};
    void raise(std::size_t index, float lowest_horizon);
  };
  [[nodiscard]] Box2d outline_of(const CityHorizon::Node& node) const;
  [[nodiscard]] BinRange bins_of(const Box2d& box) const;
  bool cull_node(const CityHorizon::Node& node, double distance_m);
  void visit_leaf(const CityHorizon::Node& leaf, double distance_m);
  [[nodiscard]] bool faces_away(const OccluderEdge& occluder) const;
  /// Those of the current occluders.
  [[nodiscard]] Thresholds& thresholds() { return is_far_terrain_ ? of_far_terrain_ : of_city_; }
  void update_leaf_bound(const BinRange& range);
  [[nodiscard]] bool is_below_leaf_bound(const OccluderEdge& occluder) const;
  enum class Visibility : std::uint8_t { hidden, weak, significant };
  Visibility classify(const OccluderEdge& occluder);
  [[nodiscard]] Visibility visibility_of(const OccluderEdge& occluder);
  void raise_by_bounds(const OccluderEdge& occluder, std::vector<float>& rows);
  void raise_by_box(const BinRange& range, double z_high_m, double nearest_m, std::vector<float>& rows);
  void update_thresholds(const BinRange& range);

  const CityHorizon& city_;
  const ReceiverCell& cell_;
  const BinBorders& borders_;
  const AzimuthBins& bins_;
  bool is_far_terrain_ = false;  ///< the current node is of the far terrain
  CullResult result_;
  std::vector<float> lowest_horizon_;
  Thresholds of_city_, of_far_terrain_;
  std::vector<double> leaf_bound_;  ///< for each layer: what stays below this slope is culled and bounded in all bins of the leaf
  EdgeOverSquare edge_;             ///< the current occluder, seen from all over the cell
  std::vector<double> bounds_;      ///< of the current occluder: EdgeOverSquare::high, level by level
};

}  // namespace farlod
