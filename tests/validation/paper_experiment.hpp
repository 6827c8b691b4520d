// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "city/city_model.hpp"
#include "evaluate/verification.hpp"

namespace farlod {

/// The paper's experiment: random receivers 1.5 m above the ground, against rays that see the whole city.
struct PaperExperiment {
  std::vector<double> cell_edges_m{50.0, 100.0};
  int neighborhood = 3;
  double bearing_deg = 0.0;  ///< of the grid
  std::size_t receivers = 2000;
  std::size_t reference_rays = 20000;
  std::size_t default_rays = 1000;  ///< what farlod-svf takes when nobody says
};

struct PaperRow {
  double cell_edge_m = 0.0;
  ErrorSummary dropped;    ///< the far field left out, with the rays of the reference
  ErrorSummary far_map;    ///< the paper's map, with the rays of the reference: the map's error alone
  ErrorSummary delivered;  ///< the paper's map with the default rays: what a user gets
};

/// The receivers are the same for all cell edges.
[[nodiscard]] std::vector<PaperRow> run_paper_experiment(const CityModel& city, const PaperExperiment& experiment);

}  // namespace farlod
