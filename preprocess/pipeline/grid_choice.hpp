// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "align/align.hpp"
#include "city/located_city.hpp"
#include "city/terrain_raster.hpp"
#include "farlod/pack.hpp"
#include "farmap/far_map_settings.hpp"
#include "tiles/tiles.hpp"
#include "trial/far_map_trial.hpp"

namespace farlod::pipeline {

/// The error to keep, and the choices that may keep it.
struct ChoiceSettings {
  double max_far_error = 0.01;  ///< of the far maps alone
  std::vector<double> cell_edges_m{25.0, 50.0, 100.0, 200.0};
  std::vector<int> neighborhoods{1, 3, 5};
  std::vector<double> tolerances{0.1, 0.05, 0.02, 0.01};  ///< descending
  FarErrorSettings error_sampling;                        ///< which receivers the errors are estimated with
};

/// Lays a grid with cells of this edge over the city. Returns it with the ground below it.
using LayGrid = std::function<std::pair<Grid, std::optional<TerrainRaster>>(double cell_edge_m)>;

/// The cheapest choice whose far maps keep the error. No sampled receiver may be farther from the engine `exact` than
/// `max_far_error`, and the bounds of 99 % of them must guarantee it; farlod-svf --max-error retraces the rest. Empty when no
/// choice keeps the error. Deterministic.
[[nodiscard]] std::optional<GridChoice> choose_grid(const LocatedCity& city, const LayGrid& lay, Assign assign,
                                                    const HorizonMapSettings& far_map, const ChoiceSettings& settings,
                                                    const std::stop_token& stop = {});

}  // namespace farlod::pipeline
