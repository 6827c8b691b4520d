// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/validation/paper_experiment.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <limits>
#include <random>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/point_receivers.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {
namespace {

using scenes::grid_covering;
using scenes::pack_city;
using scenes::TemporaryFolder;

std::vector<double> evaluate(const Package& package, Engine engine, std::size_t rays,
                             const std::vector<PlaceOfReceiver>& places) {
  const SkyEvaluator evaluator(package, {engine, SkyWeight::cosine, rays});
  const auto cells = places_by_cell(package, places);
  std::vector<float> svf(places.size(), std::numeric_limits<float>::quiet_NaN());
  oneapi::tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t n) {
    evaluator.evaluate(receivers_at(package, cells[n].first, places, cells[n].second, HeightAbove::ground, 1.5F), svf);
  });
  return {svf.begin(), svf.end()};
}

/// Random places on the ground outside of buildings. In the test's city frame, projected coordinates are city coordinates.
std::vector<PlaceOfReceiver> random_places(const Package& package, std::size_t count) {
  const auto [low, high] = package.grid().rectangle();
  std::mt19937_64 random(20120901);
  const auto uniform = [&random](double a, double b) { return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<PlaceOfReceiver> places;
  while (places.size() < count) {
    const Point2d p_grid{uniform(low.x, high.x), uniform(low.y, high.y)};
    const std::vector<PlaceOfReceiver> one{{package.grid().rotation.city_from_grid(p_grid), std::nullopt}};
    const std::vector<std::size_t> first{0};
    if (!receivers_at(package, package.grid().cell_of(p_grid), one, first, HeightAbove::ground, 1.5F).receivers.empty())
      places.push_back(one[0]);
  }
  return places;
}

}  // namespace

std::vector<PaperRow> run_paper_experiment(const CityModel& city, const PaperExperiment& experiment) {
  std::vector<PlaceOfReceiver> places;
  std::vector<double> exact;
  std::vector<PaperRow> rows;
  for (const double cell_edge_m : experiment.cell_edges_m) {
    const TemporaryFolder folder;
    pack_city(city, grid_covering(city, Angle::degrees(experiment.bearing_deg), cell_edge_m, experiment.neighborhood),
              folder.path() / "city.farlod");
    const Package package(folder.path() / "city.farlod");
    if (places.empty()) {
      places = random_places(package, experiment.receivers);
      exact = evaluate(package, Engine::exact, experiment.reference_rays, places);
    }
    const auto errors = [&](Engine engine, std::size_t rays) {
      return summarize_errors(evaluate(package, engine, rays, places), exact);
    };
    rows.push_back({cell_edge_m, errors(Engine::near_only, experiment.reference_rays),
                    errors(Engine::rays, experiment.reference_rays), errors(Engine::rays, experiment.default_rays)});
  }
  return rows;
}

}  // namespace farlod
