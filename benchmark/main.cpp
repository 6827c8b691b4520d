// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmark/measurement.hpp"
#include "benchmark/performance_tables.hpp"

// Measures us against tracing the whole city, and prints the tables behind docs/performance.md. benchmark/run runs it.

namespace farlod::benchmark {
namespace {

struct Options {
  bool quick = false, maps = false;
  std::string engine = "auto", generator;
  std::filesystem::path city, overhangs;
  std::vector<std::filesystem::path> packed;
  std::vector<double> pack_s;
  std::size_t cells = 0, turns = 0;
};

Extent extent_of(const Options& options) {
  Extent extent = options.quick ? quick_extent() : Extent();
  if (options.cells > 0) extent.cells = options.cells;
  if (options.turns > 0) extent.turns = options.turns;
  return extent;
}

std::vector<SizedCity> sized_cities(const Options& options) {
  std::vector<SizedCity> cities;
  for (std::size_t n = 0; n < options.packed.size(); ++n) cities.push_back({options.packed[n], options.pack_s.at(n)});
  return cities;
}

/// What both were set to for the first target on the ground; the finest where that did not do.
Accuracy accuracy_of(const Contest& ground) {
  const ContestRow& row = ground.rows.front();
  return {row.rival.value_or(ground.rival_ladder.back()).samples, row.ours.value_or(ground.our_ladder.back()).samples};
}

std::string described(const PackageReader& package, const std::string& generator) {
  return fmt::format("`farlod-city {}`, {} polygons, cells of {:g} m, N = {}", generator, package.manifest().polygons,
                     package.grid().cell_edge_m, package.grid().neighborhood);
}

/// What benchmark/end_to_end needs to know: a line for each target of the ground.
int print_maps(const Options& options) {
  const Extent extent = extent_of(options);
  const City city(options.city);
  const double index_s = median_seconds(extent.turns, [&] { static_cast<void>(WholeCityRival(city.triangles)); });
  fmt::print("spacing_m,max_error,index_s,rival_rays,rival_error,rival_per_s,our_samples,our_error,our_per_s\n");
  for (const ContestRow& row : contest(city, Place::ground, engine_named(options.engine), extent).rows) {
    if (!row.rival || !row.ours) continue;
    const auto count = static_cast<double>(row.receivers);
    fmt::print("{:g},{:g},{:.3f},{},{:.4f},{:.0f},{},{:.4f},{:.0f}\n", row.target.spacing_m, row.target.max_error, index_s,
               row.rival->samples, row.rival->errors.max_abs, count / row.rival_s, row.ours->samples, row.ours->errors.max_abs,
               count / row.ours_s);
  }
  return 0;
}

int run(const Options& options) {
  if (options.maps) return print_maps(options);
  Results results{extent_of(options), engine_named(options.engine), "", {}, {}, {}, {}, {}};
  {
    const City city(options.city);
    results.city = described(city.package, options.generator);
    for (const Place place : {Place::ground, Place::roofs, Place::walls})
      results.contests.push_back(contest(city, place, results.ours, results.extent));
    results.sweep = study_sweep(city, results.extent);
    results.variants = study_variants(city, results.extent);
  }
  results.same_directions = same_directions_contest(City(options.overhangs), results.extent);
  results.sizes = study_sizes(sized_cities(options), results.ours, accuracy_of(results.contests.front()), results.extent);
  std::fputs(markdown(results).c_str(), stdout);
  return 0;
}

int measure(int argc, char** argv) {
  CLI::App app("farlod-benchmark — measures us against tracing the whole city, for docs/performance.md", "farlod-benchmark");
  Options options;
  app.add_flag("--quick", options.quick, "Few receivers, one turn: to see that all of it runs");
  CLI::Option* maps = app.add_flag("--maps", options.maps, "Only maps of the ground of --city, as a table of commas");
  app.add_option("--engine", options.engine, "Which of ours")->capture_default_str();
  app.add_option("--city", options.city, "Package of the contests")->required();
  app.add_option("--generator", options.generator, "The options of farlod-city that made it");
  app.add_option("--overhangs", options.overhangs, "Package of a city with overhangs")->excludes(maps);
  app.add_option("--packed", options.packed, "Package of a city of the sizes that are compared; again for each");
  app.add_option("--pack-seconds", options.pack_s, "How long packing the --packed took, in their order");
  app.add_option("--cells", options.cells, "Cells of the city that are measured");
  app.add_option("--turns", options.turns, "Medians are of so many");
  CLI11_PARSE(app, argc, argv);
  if (!options.maps && options.overhangs.empty()) throw std::runtime_error("--overhangs is required, unless there is --maps");
  return run(options);
}

}  // namespace
}  // namespace farlod::benchmark

int main(int argc, char** argv) {
  try {
    return farlod::benchmark::measure(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-benchmark: %s\n", error.what());
    return 1;
  }
}
