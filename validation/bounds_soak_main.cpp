// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <random>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/point_receivers.hpp"
#include "scene/vertical_profile.hpp"

// Asks whether certain bounds hold: for random receivers of a package, on the ground, on whatever is highest, on roofs, on walls
// and above roofs, is `exact` with the same rays within [low, high]?

namespace farlod {
namespace {

struct Options {
  std::string package;
  std::size_t receivers = 10000, rays = 1000;
  std::uint64_t seed = 1;
};

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(uniform(0.0, static_cast<double>(end))); }

 private:
  std::mt19937_64 engine_;
};

enum Kind : std::size_t { ground, surface, roofs, walls, above_roofs, kind_count };
constexpr std::array<const char*, kind_count> names{"ground", "surface", "roofs", "walls", "above roofs"};

/// Receivers of one kind somewhere in a cell, at the most so many: places inside buildings have none.
std::vector<Receiver> random_receivers(const PackageReader& package, Cell cell, Kind kind, std::size_t count, Random& random) {
  std::vector<Receiver> chosen;
  if (kind == roofs || kind == walls) {
    constexpr double spacing_m = 2.0;
    auto all = surface_receivers(package, cell, kind == roofs ? SurfaceChoice::roofs : SurfaceChoice::walls, spacing_m);
    std::erase_if(all, [](const SurfaceReceiver& r) { return r.is_inside_building; });
    for (std::size_t n = 0; n < count && !all.empty(); ++n) {
      const SurfaceReceiver& r = all[random.below(all.size())];
      chosen.push_back({chosen.size(), r.p_cell, r.normal});
    }
    return chosen;
  }
  constexpr float eye_m = 1.5F, on_it_m = 0.05F;
  const double edge_m = package.grid().cell_edge_m;
  const PointLocator locator(package, cell);
  for (std::size_t n = 0; n < count; ++n) {
    const auto x = static_cast<float>(random.uniform(0.0, edge_m)), y = static_cast<float>(random.uniform(0.0, edge_m));
    const auto above_m = kind == above_roofs ? static_cast<float>(random.uniform(0.5, 40.0)) : kind == ground ? eye_m : on_it_m;
    const auto p = stand(locator, x, y, kind == ground ? HeightAbove::ground : HeightAbove::highest_surface, above_m);
    if (p) chosen.push_back({chosen.size(), *p, {0.0F, 0.0F, 1.0F}});
  }
  return chosen;
}

struct Outcome {
  std::size_t receivers = 0, outside_by_a_ray = 0, outside_by_more = 0;
  double width_sum = 0.0, width_max = 0.0, worst = 0.0;

  void add(const Outcome& o) {
    receivers += o.receivers, outside_by_a_ray += o.outside_by_a_ray, outside_by_more += o.outside_by_more;
    width_sum += o.width_sum, width_max = std::max(width_max, o.width_max), worst = std::max(worst, o.worst);
  }
};

Outcome compare(const SkyEvaluator& ours, const SkyEvaluator& reference, const CellReceivers& cell, std::size_t rays) {
  std::vector<float> svf(cell.receivers.size()), low(svf), high(svf), exact(svf);
  ours.evaluate(cell, SkyAnswers(svf, low, high));
  reference.evaluate(cell, exact);
  Outcome outcome{cell.receivers.size()};
  const double ray = 1.0 / static_cast<double>(rays);
  for (std::size_t n = 0; n < exact.size(); ++n) {
    const double beyond = std::max(static_cast<double>(low[n]) - exact[n], static_cast<double>(exact[n]) - high[n]);
    outcome.outside_by_a_ray += beyond > 0.5 * ray ? 1U : 0U;
    outcome.outside_by_more += beyond > 2.5 * ray ? 1U : 0U;
    outcome.worst = std::max(outcome.worst, beyond);
    const double width = static_cast<double>(high[n]) - low[n];
    outcome.width_sum += width;
    outcome.width_max = std::max(outcome.width_max, width);
  }
  return outcome;
}

using OutcomeOfKinds = std::array<Outcome, kind_count>;

/// Over all cells of a package; about as many receivers as the options say.
OutcomeOfKinds compare_everywhere(const PackageReader& package, const Options& options) {
  const CellRange& cells = package.grid().cells;
  const SkyEvaluator ours(package, {Engine::rays, SkyWeight::cosine, options.rays, std::nullopt});
  const SkyEvaluator reference(package, {Engine::exact, SkyWeight::cosine, options.rays, std::nullopt});
  const auto cell_count = static_cast<std::size_t>(cells.size());
  if (cell_count == 0) return {};
  const std::size_t of_kind = std::max<std::size_t>(1, options.receivers / (kind_count * cell_count));
  std::vector<OutcomeOfKinds> by_cell(cell_count);
  oneapi::tbb::parallel_for(std::size_t{0}, cell_count, [&](std::size_t n) {
    Random random(options.seed * 1'000'003 + n);
    for (std::size_t kind = 0; kind < kind_count; ++kind) {
      const Cell cell = cells.cell_at(n);
      const CellReceivers some{cell, random_receivers(package, cell, static_cast<Kind>(kind), of_kind, random)};
      if (!some.receivers.empty()) by_cell[n][kind] = compare(ours, reference, some, options.rays);
    }
  });
  OutcomeOfKinds all;
  for (const OutcomeOfKinds& of_cell : by_cell)
    for (std::size_t kind = 0; kind < kind_count; ++kind) all[kind].add(of_cell[kind]);
  return all;
}

int run(const Options& options) {
  const PackageReader package(options.package);
  const OutcomeOfKinds outcomes = compare_everywhere(package, options);
  std::size_t outside = 0;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const Outcome& all = outcomes[kind];
    std::printf(
        "%-12s %8zu receivers, outside of their bounds %zu, by more than two rays %zu (worst %.4f); width mean %.4f, max %.4f\n",
        names[kind], all.receivers, all.outside_by_a_ray, all.outside_by_more, all.worst,
        all.width_sum / static_cast<double>(std::max<std::size_t>(1, all.receivers)), all.width_max);
    outside += all.outside_by_more;
  }
  return outside == 0 ? 0 : 1;
}

}  // namespace
}  // namespace farlod

// Only a mistake in the description of the options is not caught. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("farlod-bounds-soak — do certain bounds hold?", "farlod-bounds-soak");
  farlod::Options options;
  app.add_option("PACKAGE", options.package, "A package with far maps of the kind horizon")->required();
  app.add_option("--receivers", options.receivers, "How many, of all kinds together; at least one of each in every cell")
      ->capture_default_str();
  app.add_option("--rays", options.rays, "Directions a receiver")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the places")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return farlod::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-bounds-soak: %s\n", error.what());
    return 2;
  }
}
