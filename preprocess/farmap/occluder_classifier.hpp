// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "farmap/bin_borders.hpp"
#include "farmap/city_horizon.hpp"
#include "farmap/edge_over_square.hpp"
#include "farmap/occlusion_culler.hpp"
#include "farmap/viewpoint_horizons.hpp"
#include "package/baked_block.hpp"

namespace farlod {

/// Decides for each patch of a cell which candidates are explicit, and bounds the others.
class OccluderClassifier {
 public:
  /// All must outlive it; `map` gets the explicit occluders and the bounds. The tolerance is HorizonMapSettings::tolerance.
  OccluderClassifier(const CityHorizon& city, const ReceiverCell& cell, const ViewpointHorizons& viewpoints,
                     const BinBorders& borders, double tolerance, BakedHorizon& map);

  /// Makes an occluder (by its number in the city) explicit for the patches where it is significant, and bounds it for the
  /// others. Returns the layers in which it is explicit, as bits.
  std::uint32_t classify(std::uint32_t number);
  /// No sky is seen below a lower border that grounded edges hide for certain: takes such ones out of the map. To be called last.
  void drop_hidden_overhangs();

 private:
  void set_thresholds(std::uint32_t patch);
  [[nodiscard]] bool is_significant(std::uint32_t patch, EdgeRole role);
  void add_to_residual(std::uint32_t patch, EdgeRole role);

  const CityHorizon& city_;
  const ReceiverCell& cell_;
  const ViewpointHorizons& viewpoints_;
  const AzimuthBins& bins_;
  double tolerance_;
  BakedHorizon& map_;
  std::vector<float> lowest_horizon_;      ///< rows as in the map: the lowest horizon that the patch's viewpoints see
  std::vector<double> significant_above_;  ///< likewise: no edge below this slope is significant
  std::vector<float> grounded_low_;        ///< likewise: residual grounded edges hide everything below it for certain
  EdgeOverSquare edge_;                    ///< the current occluder, seen from all over a square
};

}  // namespace farlod
