// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "farmap/baked_block.hpp"
#include "farmap/bin_borders.hpp"
#include "farmap/cell_place.hpp"
#include "farmap/city_horizon.hpp"
#include "farmap/edge_over_square.hpp"
#include "farmap/viewpoint_horizons.hpp"

namespace farlod {

/// Decides for each patch of a cell which occluders are explicit, and bounds the others.
class OccluderClassifier {
 public:
  /// All must outlive it; `map` gets names and bounds. The tolerance is HorizonMapSettings::tolerance.
  OccluderClassifier(const CityHorizon& city, const CellPlace& place, const ViewpointHorizons& views, const BinBorders& borders,
                     double tolerance, BakedHorizon& map);

  /// Names an occluder (by its number in the city) for the patches where that is worth it, and bounds it for the others. Returns
  /// the layers in which it is explicit, as bits.
  std::uint32_t judge(std::uint32_t occluder);
  /// Lower borders below what is surely hidden show no sky: takes them out of the map. To be called last.
  void drop_hidden_overhangs();

 private:
  void see_from(std::uint32_t patch);
  [[nodiscard]] bool matters(std::uint32_t patch, EdgeRole role);
  void add_to_residual(std::uint32_t patch, EdgeRole role);

  const CityHorizon& city_;
  const CellPlace& place_;
  const ViewpointHorizons& views_;
  const AzimuthBins& bins_;
  double tolerance_;
  BakedHorizon& map_;
  std::vector<float> seen_;      ///< rows as in the map: what receivers in the patch likely cannot see over
  std::vector<double> limits_;   ///< likewise: what stays below this does not matter
  std::vector<float> grounded_;  ///< likewise: below this, residual grounded things hide everything for certain
  EdgeOverSquare edge_;          ///< the occluder at hand
};

}  // namespace farlod
