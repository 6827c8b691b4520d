// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "receivers/point_receivers.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/scenes/light_by_rays.hpp"
#include "weather/light_of_weather.hpp"
#include "weather/weather.hpp"

// Is the irradiation of a year and of its months, which comes from one distribution over the sky, that of each hour and ray?
// Random receivers of a package, 1.5 m above the ground, on roofs and on walls, against brute force. Nothing is reflected.

namespace farlod::validation {
namespace {

struct Options {
  std::filesystem::path package, weather;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  std::size_t receivers = 200, directions = 20'000, azimuths = 320;
  std::int64_t judge_step_s = 60;
  std::uint64_t seed = 1;
};

Light light_of(const Options& options, std::chrono::seconds step) {
  const PlaceOnEarth place{Angle::degrees(options.longitude_deg), Angle::degrees(options.latitude_deg)};
  constexpr double linke_turbidity = 3.0;
  const Weather weather = options.weather.empty()
                              ? clear_sky_weather(place, period_in("2025"), std::chrono::hours(1), linke_turbidity)
                              : read_weather(options.weather, place);
  Light light{farlod::light_of(weather, weather.place.value_or(place), step).intervals, SkyModel::perez, 0.0, 0.0};
  light.by_month = true;
  return light;
}

constexpr std::size_t of_kind_in_cell = 3;

/// Some receivers on the ground and on surfaces of a cell.
CellReceivers receivers_in(const PackageReader& package, Cell cell, std::mt19937_64& random) {
  constexpr double spacing_m = 4.0;
  constexpr float eye_m = 1.5F;
  const double edge_m = package.grid().cell_edge_m;
  const auto uniform = [&] { return edge_m * static_cast<double>(random() >> 11U) * 0x1p-53; };
  std::vector<PlaceOfReceiver> places;
  for (std::size_t n = 0; n < of_kind_in_cell; ++n) {
    const Point2d p_grid = package.grid().corner_of(cell) + Point2d{uniform(), uniform()};
    places.push_back({horizontal(package.manifest().projected_from_grid({p_grid.x, p_grid.y, 0.0})), std::nullopt});
  }
  std::vector<std::size_t> all(places.size());
  std::iota(all.begin(), all.end(), 0);
  CellReceivers found = receivers_at(package, cell, places, all, HeightAbove::ground, eye_m);
  std::vector<SurfaceReceiver> on_surfaces = surface_receivers(package, cell, SurfaceChoice::all, spacing_m);
  std::erase_if(on_surfaces, [](const SurfaceReceiver& r) { return r.is_inside_building; });
  std::shuffle(on_surfaces.begin(), on_surfaces.end(), random);
  on_surfaces.resize(std::min(on_surfaces.size(), 2 * of_kind_in_cell));
  for (const SurfaceReceiver& r : on_surfaces) found.receivers.push_back({0, r.p_cell, r.normal});
  for (std::size_t n = 0; n < found.receivers.size(); ++n) found.receivers[n].index = n;
  return found;
}

std::vector<CellReceivers> chosen_receivers(const PackageReader& package, const Options& options) {
  std::mt19937_64 random(options.seed);
  std::vector<CellReceivers> cells;
  const auto cell_count = static_cast<std::uint64_t>(std::max<std::int64_t>(1, package.grid().cells.size()));
  for (std::size_t count = 0; count < options.receivers;) {
    const Cell cell = package.grid().cells.cell_at(random() % cell_count);
    if (!package.has_far_map(cell)) continue;
    CellReceivers some = receivers_in(package, cell, random);
    if (some.receivers.size() <= of_kind_in_cell) continue;  // without buildings
    count += some.receivers.size();
    cells.push_back(std::move(some));
  }
  return cells;
}

/// A line of a table for --points: x, y, z, azimuth and tilt.
std::string place_of(const PackageReader& package, const CellReceivers& cell, std::size_t receiver) {
  const Grid& grid = package.grid();
  const package::Manifest& m = package.manifest();
  const auto& [index, p, normal] = cell.receivers[receiver];
  const Point2d p_m = m.origin_m + grid.rotation.city_from_grid(grid.corner_of(cell.cell) +
                                                                Point2d{static_cast<double>(p.x), static_cast<double>(p.y)});
  const Point2d looks = grid.rotation.city_from_grid(Point2d{static_cast<double>(normal.x), static_cast<double>(normal.y)});
  char text[100];
  std::snprintf(text, sizeof(text), "%.3f,%.3f,%.3f,%.3f,%.3f", p_m.x, p_m.y, m.height_origin_m + static_cast<double>(p.z),
                Angle::radians(std::atan2(looks.x, looks.y)).degrees(),
                Angle::radians(std::acos(static_cast<double>(normal.z))).degrees());
  return text;
}

/// |value − truth| / truth of all receivers, for years, and for months of which a receiver gets something.
struct Errors {
  std::vector<double> of_years, of_months;
};
constexpr double something_kwh_m2 = 1.0;

/// Adds an error, and tells one that is larger than `worth_telling`.
void add_error(const std::string& of_what, double got_kwh_m2, double truth_kwh_m2, double worth_telling,
               std::vector<double>& errors) {
  if (truth_kwh_m2 < something_kwh_m2) return;
  errors.push_back(std::abs(got_kwh_m2 / truth_kwh_m2 - 1.0));
  if (errors.back() > worth_telling) std::printf("%s: %.2f kWh/m² instead of %.2f\n", of_what.c_str(), got_kwh_m2, truth_kwh_m2);
}

std::vector<scenes::LightByRays::Months> truths_of(const CellReceivers& cell, const PackageReader& package,
                                                   const WholeCityOnDemand& city, const scenes::LightByRays& judge) {
  std::vector<scenes::LightByRays::Months> truths(cell.receivers.size());
  oneapi::tbb::parallel_for(std::size_t{0}, truths.size(), [&](std::size_t n) {
    const Receiver& r = cell.receivers[n];
    truths[n] = judge.on(city.city().scene_from_cell(r.p_cell, cell.cell), {r.normal.x, r.normal.y, r.normal.z},
                         city.city().occluder(), package.has_crowns() ? &city.crowns({}) : nullptr);
  });
  return truths;
}

void add_errors(const SkyEvaluator& evaluator, const CellReceivers& cell, const WholeCityOnDemand& city,
                const scenes::LightByRays& judge, Errors& errors) {
  const PackageReader& package = evaluator.package();
  const std::size_t columns = evaluator.further_columns();
  std::vector<float> svf(cell.receivers.size()), values(svf.size() * columns);
  evaluator.evaluate(cell, SkyAnswers(svf, {}, {}, values));
  const std::vector<scenes::LightByRays::Months> truths = truths_of(cell, package, city, judge);
  constexpr std::size_t first_month = 4;
  constexpr double of_year = 0.005, of_month = 0.01;
  for (std::size_t n = 0; n < truths.size(); ++n) {
    const double year = scenes::year_of(truths[n]);
    if (year < something_kwh_m2) continue;
    const auto got = [&](std::size_t column) { return static_cast<double>(values[n * columns + column]); };
    const std::string place = place_of(package, cell, n) + " with svf " + std::to_string(svf[n]);
    add_error(place, got(0), year, of_year, errors.of_years);
    for (std::size_t m = 0; m + first_month < columns; ++m)
      add_error(place + ", month " + std::to_string(m + 1), got(first_month + m), truths[n][m], of_month, errors.of_months);
  }
}

void print(const char* what, std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  const auto percent_at = [&](double share) {
    return 100.0 * errors[std::min(errors.size() - 1, static_cast<std::size_t>(share * static_cast<double>(errors.size())))];
  };
  double sum = 0.0;
  for (const double error : errors) sum += error;
  std::printf("%s: %zu, error mean %.3f %%, median %.3f %%, 95 %% within %.3f %%, 99 %% within %.3f %%, largest %.2f %%\n", what,
              errors.size(), 100.0 * sum / static_cast<double>(errors.size()), percent_at(0.5), percent_at(0.95),
              percent_at(0.99), percent_at(1.0));
}

void run(const Options& options) {
  const PackageReader package(options.package);
  const Light light = light_of(options, std::chrono::minutes(5));
  // The sun goes on between its positions: the judge has more of them, spread over its disk
  const scenes::LightByRays judge(light_of(options, std::chrono::seconds(options.judge_step_s)), options.directions,
                                  package.grid().rotation, package.manifest().convergence);
  const WholeCityOnDemand city(package, {});
  const SkySettings settings{.azimuths = options.azimuths, .further = {.light = light, .irradiation = true}};
  const SkyEvaluator evaluator(package, settings);
  Errors errors;
  for (const CellReceivers& cell : chosen_receivers(package, options)) add_errors(evaluator, cell, city, judge, errors);
  print("years ", errors.of_years);
  print("months", errors.of_months);
}

}  // namespace
}  // namespace farlod::validation

// Only a mistake in the description of the options is not caught. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  farlod::validation::Options options;
  CLI::App app("Compares the irradiation of a year and its months with brute force: each hour, sun by sun, sky ray by ray");
  app.add_option("package", options.package, "With far maps of the kind horizon")->required();
  app.add_option("--weather", options.weather, "Otherwise a clear year in hours");
  app.add_option("--latitude", options.latitude_deg)->required();
  app.add_option("--longitude", options.longitude_deg)->required();
  app.add_option("--receivers", options.receivers)->capture_default_str();
  app.add_option("--directions", options.directions, "Of the sky's light")->capture_default_str();
  app.add_option("--judge-step", options.judge_step_s, "Between places of the judge's sun, in seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--azimuths", options.azimuths)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    farlod::validation::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
