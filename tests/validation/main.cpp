// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include "tests/scenes/generated_town.hpp"
#include "tests/validation/paper_experiment.hpp"

// Prints the table of docs/validation.md. The city: farlod-city --size 3520 --seed 1 --towers 0.3 --rotation 20 --lod 1.

namespace {

void print_row(double cell_edge_m, const char* what, const farlod::ErrorSummary& e) {
  std::printf("| %g | %s | %.4f | %.4f | %.4f | %+.4f |\n", cell_edge_m, what, e.mean_abs_error, e.p99_abs_error, e.max_abs_error,
              e.bias);
}

void run() {
  farlod::CitySettings settings;
  settings.size_m = 3520;
  settings.tower_share = 0.3;
  settings.rotation_deg = 20;
  const farlod::CityModel city = farlod::scenes::generated_town(settings);
  farlod::PaperExperiment experiment;
  experiment.bearing_deg = settings.rotation_deg;
  std::printf(
      "Generated city: %zu buildings, %llu polygons; %zu receivers 1.5 m above ground; N = %d; against %zu rays that see the "
      "whole city.\n\n",
      city.buildings().size(), static_cast<unsigned long long>(city.surface_count()), experiment.receivers,
      experiment.neighborhood, experiment.reference_rays);
  std::printf("| cell, m | far field | mean | 99 %% | max | bias |\n|---|---|---|---|---|---|\n");
  for (const farlod::PaperRow& row : farlod::run_paper_experiment(city, experiment)) {
    print_row(row.cell_edge_m, "dropped", row.dropped);
    print_row(row.cell_edge_m, "paper's map", row.far_map);
    print_row(row.cell_edge_m, "paper's map, 1,000 rays (the default)", row.delivered);
  }
}

}  // namespace

int main() {
  try {
    run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-paper-experiment: %s\n", error.what());
    return 1;
  }
}
