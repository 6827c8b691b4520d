// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <random>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/point_receivers.hpp"

// Asks whether certain bounds hold: for random receivers of a package, on the ground, in the air between the houses and on
// surfaces, looking up or sideways, is `exact` with the same rays within [low, high]?

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

 private:
  std::mt19937_64 engine_;
};

Point3f sideways(Random& random) {
  const double azimuth = random.uniform(0.0, 2.0 * std::numbers::pi), tilt = random.uniform(0.0, 0.6 * std::numbers::pi);
  return {static_cast<float>(std::sin(tilt) * std::cos(azimuth)), static_cast<float>(std::sin(tilt) * std::sin(azimuth)),
          static_cast<float>(std::cos(tilt))};
}

/// One receiver somewhere in the package; none when the place is inside a building.
CellReceivers random_receiver(const Package& package, Random& random) {
  const auto [low, high] = package.grid().rectangle();
  const Point2d p_grid{random.uniform(low.x, high.x), random.uniform(low.y, high.y)};
  const Point3d p = package.manifest().projected_from_grid({p_grid.x, p_grid.y, 0.0});
  const std::vector<PlaceOfReceiver> place{{horizontal(p), std::nullopt}};
  const bool on_surface = random.uniform(0.0, 1.0) < 0.3;
  const double height_m = random.uniform(0.0, 1.0) < 0.5 ? 1.5 : random.uniform(0.05, 60.0);
  CellReceivers found = receivers_at(package, package.grid().cell_of(p_grid), place, std::vector<std::size_t>{0},
                                     on_surface ? HeightAbove::highest_surface : HeightAbove::ground,
                                     static_cast<float>(on_surface ? 0.05 : height_m));
  const bool looks_sideways = random.uniform(0.0, 1.0) < 0.3;
  for (Receiver& r : found.receivers)
    if (looks_sideways) r.normal = sideways(random);
  return found;
}

struct Outcome {
  std::size_t receivers = 0, outside = 0, outside_by_more_than_a_ray = 0;
  double width_sum = 0.0, width_max = 0.0, worst = 0.0;
};

Outcome soak(const Package& package, const Options& options) {
  Random random(options.seed);
  std::vector<CellReceivers> receivers;
  while (receivers.size() < options.receivers) {
    CellReceivers one = random_receiver(package, random);
    if (one.receivers.empty()) continue;
    one.receivers[0].index = receivers.size();
    receivers.push_back(std::move(one));
  }
  const SkyEvaluator ours(package, {Engine::rays, SkyWeight::cosine, options.rays, std::nullopt});
  const SkyEvaluator reference(package, {Engine::exact, SkyWeight::cosine, options.rays, std::nullopt});
  std::vector<float> svf(receivers.size()), low(svf), high(svf), exact(svf);
  oneapi::tbb::parallel_for(std::size_t{0}, receivers.size(), [&](std::size_t n) {
    ours.evaluate(receivers[n], SkyAnswers(svf, low, high));
    reference.evaluate(receivers[n], exact);
  });
  Outcome outcome{receivers.size()};
  const double ray = 1.0 / static_cast<double>(options.rays);
  for (std::size_t n = 0; n < receivers.size(); ++n) {
    const double beyond = std::max(static_cast<double>(low[n]) - exact[n], static_cast<double>(exact[n]) - high[n]);
    outcome.outside += beyond > 0.5 * ray ? 1U : 0U;
    outcome.outside_by_more_than_a_ray += beyond > 1.5 * ray ? 1U : 0U;
    outcome.worst = std::max(outcome.worst, beyond);
    const double width = static_cast<double>(high[n]) - low[n];
    outcome.width_sum += width;
    outcome.width_max = std::max(outcome.width_max, width);
  }
  return outcome;
}

int run(const Options& options) {
  const Package package(options.package);
  const Outcome o = soak(package, options);
  std::printf(
      "%zu receivers, %zu rays: %zu outside of their bounds, %zu by more than one ray (worst %.4f); width mean %.4f, max %.4f\n",
      o.receivers, options.rays, o.outside, o.outside_by_more_than_a_ray, o.worst, o.width_sum / static_cast<double>(o.receivers),
      o.width_max);
  return o.outside_by_more_than_a_ray == 0 ? 0 : 1;
}

}  // namespace
}  // namespace farlod

int main(int argc, char** argv) {
  CLI::App app("farlod-bounds-soak — do certain bounds hold?", "farlod-bounds-soak");
  farlod::Options options;
  app.add_option("PACKAGE", options.package, "A package with far maps of the kind horizon")->required();
  app.add_option("--receivers", options.receivers, "How many")->capture_default_str();
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
