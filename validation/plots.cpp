// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>
#include <vector>

#include "evaluate/error_budget.hpp"
#include "validation/report.hpp"
#include "validation/svg_plot.hpp"

namespace farlod::validation {
namespace {

constexpr std::size_t red = 0, orange = 1, blue = 2, green = 3, violet = 4, grey = 5;

using ErrorOf = double (*)(const ErrorSummary&);
double mean_of(const ErrorSummary& e) { return e.mean_abs_error; }
double max_of(const ErrorSummary& e) { return e.max_abs_error; }

/// Errors against the neighborhood, with cells of 50 m.
Plot far_field_plot(const CityStudy& study) {
  Plot plot{study.name + ": error of the far field, cells of 50 m",
            {"N (cells along the edge of the near field)", Scale::linear},
            {"|error| of the sky view factor", Scale::logarithmic},
            {}};
  const auto add = [&](const std::string& label, std::size_t colour, ErrorSummary FarFieldErrors::*which) {
    Series max{label + ", max", colour, false, {}}, mean{label + ", mean", colour, true, {}};
    for (const FarFieldRow& row : study.rows) {
      if (row.cell_edge_m != 50.0) continue;
      max.points.emplace_back(row.neighborhood, max_of(row.ground.*which));
      mean.points.emplace_back(row.neighborhood, mean_of(row.ground.*which));
    }
    plot.series.push_back(max);
    plot.series.push_back(mean);
  };
  add("dropped", red, &FarFieldErrors::dropped);
  add("paper's map", orange, &FarFieldErrors::box);
  add("ours", blue, &FarFieldErrors::horizon);
  return plot;
}

Plot sampling_plot(const CityResults& city) {
  Plot plot{city.far_field.name + ": error of the sampling",
            {"rays a receiver", Scale::logarithmic},
            {"|error| of the sky view factor", Scale::logarithmic},
            {}};
  const auto add = [&](const std::string& label, std::size_t colour, ErrorSummary SamplingRow::*which, ErrorOf error,
                       bool dashed) {
    Series series{label, colour, dashed, {}};
    for (const SamplingRow& row : city.sampling) series.points.emplace_back(static_cast<double>(row.rays), error(row.*which));
    plot.series.push_back(series);
  };
  add("ground, max", blue, &SamplingRow::ground, max_of, false);
  add("roofs, max", red, &SamplingRow::roofs, max_of, false);
  add("façades, max", green, &SamplingRow::facades, max_of, false);
  add("ground, mean", blue, &SamplingRow::ground, mean_of, true);
  add("roofs, mean", red, &SamplingRow::roofs, mean_of, true);
  add("façades, mean", green, &SamplingRow::facades, mean_of, true);
  Series law{"2.4 · rays^(−3/4)", grey, true, {}};
  for (const SamplingRow& row : city.sampling) {
    const auto rays = static_cast<double>(row.rays);
    law.points.emplace_back(rays, sampling_error_factor * std::pow(rays, -0.75));
  }
  plot.series.push_back(law);
  return plot;
}

Plot alignment_plot(const std::vector<CityResults>& cities) {
  Plot plot{"grid turned away from the streets, cells of 50 m, N = 3",
            {"turned by, degrees", Scale::linear},
            {"|error| of the sky view factor, mean", Scale::logarithmic},
            {}};
  std::size_t colour = red;
  for (const CityResults& city : cities) {
    Series papers{city.far_field.name + ", paper's map", colour, true, {}},
        ours{city.far_field.name + ", ours", colour, false, {}};
    for (const TurnedRow& row : city.alignment.turned) {
      papers.points.emplace_back(row.turn_deg, row.box.mean_abs_error);
      ours.points.emplace_back(row.turn_deg, row.horizon.mean_abs_error);
    }
    plot.series.push_back(papers);
    plot.series.push_back(ours);
    colour = colour == red ? blue : colour == blue ? green : violet;
  }
  return plot;
}

Plot bounds_plot(const std::vector<CityResults>& cities) {
  Plot plot{"width of certain intervals, cells of 50 m",
            {"N (cells along the edge of the near field)", Scale::linear},
            {"high − low", Scale::logarithmic},
            {}};
  std::size_t colour = red;
  for (const CityResults& city : cities) {
    Series max{city.far_field.name + ", max", colour, false, {}}, mean{city.far_field.name + ", mean", colour, true, {}};
    for (const FarFieldRow& row : city.far_field.rows) {
      if (row.cell_edge_m != 50.0) continue;
      max.points.emplace_back(row.neighborhood, row.ground.bounds.max_width);
      mean.points.emplace_back(row.neighborhood, row.ground.bounds.mean_width);
    }
    plot.series.push_back(max);
    plot.series.push_back(mean);
    colour = colour == red ? blue : colour == blue ? green : violet;
  }
  return plot;
}

}  // namespace

void write_plots(const Results& results, const std::filesystem::path& folder) {
  for (const CityResults& city : results.cities) {
    write_svg(far_field_plot(city.far_field), folder / ("far_field_" + city.far_field.name + ".svg"));
    write_svg(sampling_plot(city), folder / ("sampling_" + city.far_field.name + ".svg"));
  }
  write_svg(alignment_plot(results.cities), folder / "alignment.svg");
  write_svg(bounds_plot(results.cities), folder / "bounds.svg");
}

}  // namespace farlod::validation
