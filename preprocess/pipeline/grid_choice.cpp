// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/grid_choice.hpp"

#include <algorithm>

namespace farlod::pipeline {
namespace {

/// What a map of 2 m costs for each of its receivers: its horizon, the edges that are looked at for it, near and far, and a share
/// of the gathering of the cell's edges and of its far map. Constants from docs/decisions/0017; only their ratios matter.
double expected_receiver_us(const FarErrorEstimate& far_error, double cell_edge_m) {
  constexpr double horizon_us = 1.1, edge_us = 0.00025, bake_us = 2200.0, gather_us = 0.1, grid_step_m = 2.0;
  const double edges = far_error.explicit_edges_per_cell + far_error.near_triangles_per_cell;
  const double receivers = std::max(1.0, cell_edge_m * cell_edge_m / (grid_step_m * grid_step_m));
  return horizon_us + edge_us * edges + (bake_us + gather_us * edges) / receivers;
}

bool keeps(const FarErrorEstimate& far_error, double max_far_error) {
  return far_error.receivers > 0 && far_error.max_error <= max_far_error && far_error.p99_half_width <= max_far_error;
}

class GridChooser {
 public:
  GridChooser(const LocatedCity& city, Assign assign, const HorizonMapSettings& far_map, const ChoiceSettings& settings,
              std::stop_token stop)
      : city_(city), assign_(assign), far_map_(far_map), settings_(settings), stop_(std::move(stop)) {}

  void try_cells(double cell_edge_m, const LayGrid& lay) {
    auto [grid, terrain] = lay(cell_edge_m);
    Report unread;  // the run itself reports what it finds
    const TileSet tiles = tiles::cut_into_tiles(city_, grid, assign_, terrain, unread, stop_);
    const FarMapTrial trial(tiles, grid, assign_, settings_.error_sampling, stop_);
    for (const int neighborhood : settings_.neighborhoods) try_tolerances(trial, grid.cell_edge_m, neighborhood);
  }
  std::optional<GridChoice> best;

 private:
  /// The coarsest that is fine enough.
  void try_tolerances(const FarMapTrial& trial, double cell_edge_m, int neighborhood) {
    for (const double tolerance : settings_.tolerances) {
      HorizonMapSettings far_map = far_map_;
      far_map.tolerance = tolerance;
      GridChoice choice{cell_edge_m, neighborhood, tolerance, trial.run(neighborhood, far_map), 0.0};
      choice.receiver_us = expected_receiver_us(choice.far_error, cell_edge_m);
      if (!keeps(choice.far_error, settings_.max_far_error)) continue;
      if (!best || choice.receiver_us < best->receiver_us) best = choice;
      return;
    }
  }

  const LocatedCity& city_;
  Assign assign_;
  HorizonMapSettings far_map_;
  const ChoiceSettings& settings_;
  std::stop_token stop_;
};

}  // namespace

std::optional<GridChoice> choose_grid(const LocatedCity& city, const LayGrid& lay, Assign assign,
                                      const HorizonMapSettings& far_map, const ChoiceSettings& settings,
                                      const std::stop_token& stop) {
  GridChooser chooser(city, assign, far_map, settings, stop);
  for (const double cell_edge_m : settings.cell_edges_m) chooser.try_cells(cell_edge_m, lay);
  return chooser.best;
}

}  // namespace farlod::pipeline
