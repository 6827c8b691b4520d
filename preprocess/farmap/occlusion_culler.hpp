// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "farmap/bin_borders.hpp"
#include "farmap/cell_place.hpp"
#include "farmap/city_horizon.hpp"
#include "farmap/edge_over_square.hpp"
#include "farmap/far_map_settings.hpp"
#include "farmap/viewpoint_horizons.hpp"

namespace farlod {

/// The far city of a cell, looked at from near to far.
///   (1) each upper border outside of the neighborhood is a candidate, or from all over the cell it lies below `hidden`
///   (2) what is hidden rises by no more than the tolerance over what the viewpoints above see of what was found before it
///   (3) what is hidden and not weak rises by no more than `weakest` of the tolerance
///   (4) each lower border outside of the neighborhood is a candidate, or lies likewise below `overhang`
struct CullResult {
  std::vector<std::uint32_t> candidates;  ///< numbers of occluders, from near to far
  std::vector<std::uint32_t> weak;        ///< likewise: upper borders that are hidden, but likely seen
  ViewpointHorizons views;                ///< of the upper borders among the candidates, and of the weak
  std::vector<float> hidden, overhang;    ///< slopes: a row of azimuth bins for each layer
};

/// Looks around from a cell. Whole quarters that are hidden are passed over at once.
class OcclusionCuller {
 public:
  /// All must outlive it.
  OcclusionCuller(const CityHorizon& city, const CellPlace& place, const BinBorders& borders, const HorizonMapSettings& settings);

  [[nodiscard]] CullResult run() &&;

 private:
  [[nodiscard]] Box2d outline_of(const CityHorizon::Node& node) const;
  [[nodiscard]] BinRange bins_of(const Box2d& box) const;
  bool hide_node(const CityHorizon::Node& node, double distance_m);
  void add_leaf(const CityHorizon::Node& leaf, double distance_m);
  void update_bounded(const BinRange& bins);
  [[nodiscard]] bool faces_away(const OccluderEdge& occluder) const;
  [[nodiscard]] bool is_bounded(const OccluderEdge& occluder) const;
  enum class Rise : std::uint8_t { hidden, weak, significant };
  Rise look_at(const OccluderEdge& occluder);
  [[nodiscard]] Rise rise_of(const OccluderEdge& occluder);
  void hide(const OccluderEdge& occluder, std::vector<float>& rows);
  void raise_rows(const BinRange& bins, double z_high_m, double nearest_m, std::vector<float>& rows);
  void update_limits(const BinRange& bins);

  const CityHorizon& city_;
  const CellPlace& place_;
  const BinBorders& borders_;
  const AzimuthBins& bins_;
  double tolerance_, weakest_;
  CullResult found_;
  /// As CullResult::hidden: the slope over which all viewpoints see nothing yet, and those over which a rise is weak or
  /// significant.
  std::vector<float> floors_;
  std::vector<double> weak_over_, significant_over_;
  std::vector<double> bounded_slope_;  ///< for each layer, a slope that is hidden and not weak in all bins of the leaf at hand
  EdgeOverSquare over_cell_;           ///< the occluder at hand
  std::vector<double> bounds_;         ///< of the occluder at hand: its `upper`, level by level
};

}  // namespace farlod
