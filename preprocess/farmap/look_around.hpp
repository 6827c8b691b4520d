// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "farmap/bin_borders.hpp"
#include "farmap/cell_place.hpp"
#include "farmap/city_horizon.hpp"
#include "farmap/obstacle_over_square.hpp"
#include "farmap/viewpoint_horizons.hpp"

namespace farlod {

/// The far city of a cell, looked at from near to far.
///   (1) each obstacle outside of the neighbourhood is a candidate, or from all over the cell it lies below `hidden`
///   (2) what is hidden rises by no more than the tolerance over what the viewpoints above see of the candidates before it
struct Surroundings {
  std::vector<std::uint32_t> candidates;  ///< numbers of obstacles, from near to far
  ViewpointHorizons views;                ///< of the candidates that stand
  std::vector<float> hidden;              ///< slopes: a row of azimuth bins for each layer
};

/// Looks around from a cell. Whole quarters that are hidden are passed over at once.
class LookAround {
 public:
  /// All must outlive it. The tolerance is HorizonMapSettings::tolerance.
  LookAround(const CityHorizon& city, const CellPlace& place, const BinBorders& borders, double tolerance);

  [[nodiscard]] Surroundings run() &&;

 private:
  [[nodiscard]] Box2d outline_of(const CityHorizon::Node& node) const;
  [[nodiscard]] BinRange bins_of(const Box2d& box) const;
  bool hide_node(const CityHorizon::Node& node, double distance_m);
  void add_leaf(const CityHorizon::Node& leaf, double distance_m);
  void remember_what_is_settled(const BinRange& bins);
  [[nodiscard]] bool faces_away(const Obstacle& obstacle) const;
  [[nodiscard]] bool is_settled(const Obstacle& obstacle) const;
  bool hide_obstacle(const Obstacle& obstacle);
  [[nodiscard]] bool rises(const Obstacle& obstacle);
  void update_limits(const BinRange& bins);

  const CityHorizon& city_;
  const CellPlace& place_;
  const BinBorders& borders_;
  const AzimuthBins& bins_;
  double tolerance_;
  Surroundings found_;
  std::vector<float> floors_;     ///< as Surroundings::hidden: the slope over which all viewpoints see nothing yet
  std::vector<double> limits_;    ///< likewise: what does not rise over this slope is hidden
  std::vector<double> settled_;   ///< for each layer, the lowest of `hidden` over the bins of the leaf at hand
  ObstacleOverSquare over_cell_;  ///< the obstacle at hand
  std::vector<double> bounds_;    ///< of the obstacle at hand: `upper` of its edges, level by level
};

}  // namespace farlod
