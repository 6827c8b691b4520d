// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/contest.hpp"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "base/expects.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/verification.hpp"

namespace farlod::benchmark {

double median(std::vector<double> values) {
  FARLOD_EXPECTS(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Duel duel(std::size_t turns, const std::function<void()>& first, const std::function<void()>& second) {
  std::vector<double> first_s, second_s, ratio;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    first_s.push_back(seconds_of(first));
    second_s.push_back(seconds_of(second));
    ratio.push_back(second_s.back() / first_s.back());
  }
  return {median(first_s), median(second_s), median(ratio)};
}

double median_seconds(std::size_t turns, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (std::size_t turn = 0; turn < turns; ++turn) seconds.push_back(seconds_of(work));
  return median(seconds);
}

Errors errors_of(std::span<const float> answers, std::span<const float> truth) {
  FARLOD_EXPECTS(answers.size() == truth.size() && !truth.empty());
  Errors errors;
  double squares = 0.0;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const double error = std::abs(static_cast<double>(answers[n]) - static_cast<double>(truth[n]));
    errors.mean_abs += error / static_cast<double>(truth.size());
    squares += error * error;
    errors.max_abs = std::max(errors.max_abs, error);
  }
  errors.rms = std::sqrt(squares / static_cast<double>(truth.size()));
  return errors;
}

std::vector<Rung> climb(std::span<const std::size_t> ladder, const Answer& answer, std::span<const float> truth) {
  std::vector<Rung> rungs;
  for (const std::size_t samples : ladder) rungs.push_back({samples, errors_of(answer(samples), truth)});
  return rungs;
}

std::optional<Rung> rung_within(std::span<const Rung> rungs, double max_error) {
  const auto found = std::find_if(rungs.begin(), rungs.end(), [&](const Rung& r) { return r.errors.max_abs <= max_error; });
  return found == rungs.end() ? std::nullopt : std::optional(*found);
}

SkySettings OurEngine::settings(std::size_t samples) const {
  SkySettings settings;
  settings.engine = engine;
  (engine == Engine::rays ? settings.rays : settings.azimuths) = samples;
  return settings;
}

OurEngine engine_named(const std::string& name) {
  const std::vector<std::size_t> rays{256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192};
  const std::vector<std::size_t> azimuths{32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024};
  if (name == "rays") return {name, Engine::rays, "rays", rays};
  if (name == "horizon") return {name, Engine::horizon, "azimuths", azimuths, true};
  if (name == "auto") return {name, Engine::automatic, "azimuths", azimuths, true};
  throw std::runtime_error("farlod-benchmark knows no engine '" + name + "'");
}

void evaluate(const PackageReader& package, const SkySettings& settings, const CityReceivers& receivers, std::span<float> svf) {
  const SkyEvaluator evaluator(package, settings);
  oneapi::tbb::parallel_for(std::size_t{0}, receivers.cells.size(),
                            [&](std::size_t n) { evaluator.evaluate(receivers.cells[n], svf); });
}

std::vector<float> exact_answers(const PackageReader& package, const CityReceivers& receivers, std::size_t rays) {
  SkySettings settings;
  settings.engine = Engine::exact;
  settings.rays = rays;
  std::vector<float> svf(receivers.count);
  evaluate(package, settings, receivers, svf);
  return svf;
}

namespace {

std::vector<Rung> climb_rival(const City& city, const SampledField& field, const Extent& extent) {
  const Answer answer = [&](std::size_t rays) {
    std::vector<float> svf(field.sample.receivers.count);
    city.rival.evaluate(field.sample.packets, fibonacci_directions(rays), svf);
    return svf;
  };
  return climb(extent.rival_ladder, answer, field.truth);
}

std::vector<float> our_answers(const City& city, const SampledField& field, const OurEngine& ours, std::size_t samples) {
  const CityReceivers& asked = ours.shares_work ? field.all.receivers : field.sample.receivers;
  std::vector<float> svf(asked.count);
  evaluate(city.package, ours.settings(samples), asked, svf);
  if (!ours.shares_work) return svf;
  std::vector<float> of_sample;
  for (const std::size_t n : field.sample_in_all) of_sample.push_back(svf[n]);
  return of_sample;
}

std::vector<Rung> climb_ours(const City& city, const SampledField& field, const OurEngine& ours) {
  const Answer answer = [&](std::size_t samples) { return our_answers(city, field, ours, samples); };
  return climb(ours.ladder, answer, field.truth);
}

Field place_field(const City& city, Place place, double spacing_m, std::size_t cells) {
  Field field{place_receivers(city.package, spread_cells(city.package.grid(), cells), place, spacing_m), {}};
  field.packets = packets_of(city.package.grid(), field.receivers);
  return field;
}

/// Of maps with fewer receivers, more cells are measured.
std::size_t cells_for(double spacing_m, Place place, const Extent& extent) {
  const double by = spacing_m / extent.spacing_m(place);
  return static_cast<std::size_t>(static_cast<double>(extent.cells) * std::max(1.0, by * by));
}

/// Measures a row whose settings are chosen.
void measure(const City& city, const Field& field, const std::vector<Point3d>& rival_directions, const SkySettings& ours,
             std::size_t turns, ContestRow& row) {
  std::vector<float> svf(field.receivers.count);
  const Duel result = duel(
      turns, [&] { evaluate(city.package, ours, field.receivers, svf); },
      [&] { city.rival.evaluate(field.packets, rival_directions, svf); });
  row.ours_s = result.first_s;
  row.rival_s = result.second_s;
  row.ratio = result.ratio;
}

/// Where we are not good enough, however fine.
double rival_alone(const City& city, const Field& field, std::size_t rays, std::size_t turns) {
  std::vector<float> svf(field.receivers.count);
  const std::vector<Point3d> directions = fibonacci_directions(rays);
  return median_seconds(turns, [&] { city.rival.evaluate(field.packets, directions, svf); });
}

}  // namespace

Extent quick_extent() {
  Extent extent;
  extent.cells = 9;
  extent.sample = 100;
  extent.truth_rays = 10000;
  extent.turns = 1;
  extent.ground = {{4.0, 0.010}, {4.0, 0.005}, {8.0, 0.010}};
  extent.surfaces = {{6.0, 0.010}, {6.0, 0.005}};
  return extent;
}

SampledField prepare_field(const City& city, Place place, const Extent& extent) {
  SampledField field{place_field(city, place, extent.spacing_m(place), extent.cells), {}, {}, {}};
  field.sample.receivers = choose_receivers(field.all.receivers, extent.sample);
  field.sample.packets = packets_of(city.package.grid(), field.sample.receivers);
  field.sample_in_all = choose_some(field.all.receivers.count, extent.sample);
  field.truth = exact_answers(city.package, field.sample.receivers, extent.truth_rays);
  return field;
}

Contest contest(const City& city, Place place, const OurEngine& ours, const Extent& extent) {
  tell(fmt::format("{}: errors", name_of(place)));
  const SampledField sampled = prepare_field(city, place, extent);
  Contest result{place,
                 sampled.sample.receivers.count,
                 sampled.all.receivers.placing_s,
                 climb_rival(city, sampled, extent),
                 climb_ours(city, sampled, ours),
                 {}};
  for (const Target& target : extent.targets(place)) {
    tell(fmt::format("{} every {:g} m: time at a largest error of {:.3f}", name_of(place), target.spacing_m, target.max_error));
    const bool is_sampled = target.spacing_m == extent.spacing_m(place);
    const Field coarser =
        is_sampled ? Field{} : place_field(city, place, target.spacing_m, cells_for(target.spacing_m, place, extent));
    const Field& field = is_sampled ? sampled.all : coarser;
    ContestRow row{fmt::format("{} every {:g} m, max error ≤ {:.3f}", name_of(place), target.spacing_m, target.max_error), target,
                   field.receivers.count, rung_within(result.rival_ladder, target.max_error),
                   rung_within(result.our_ladder, target.max_error)};
    if (row.rival && row.ours)
      measure(city, field, fibonacci_directions(row.rival->samples), ours.settings(row.ours->samples), extent.turns, row);
    else if (row.rival)
      row.rival_s = rival_alone(city, field, row.rival->samples, extent.turns);
    result.rows.push_back(row);
  }
  return result;
}

std::vector<ContestRow> same_directions_contest(const City& city, const Extent& extent) {
  constexpr std::size_t rays = 1000;
  tell("overhangs: the same directions");
  const SampledField field = prepare_field(city, Place::ground, extent);
  const SkySettings ours = engine_named("rays").settings(rays);
  const SkyDirections all(ours.weight, rays, city.package.grid().rotation);
  const std::vector<Point3d> directions(all.facing_up().begin(), all.facing_up().end());
  std::vector<float> our_svf(field.truth.size()), rival_svf(our_svf);
  evaluate(city.package, ours, field.sample.receivers, our_svf);
  city.rival.evaluate(field.sample.packets, directions, rival_svf);
  ContestRow row{fmt::format("overhangs, ground, engine `rays`, the same {} directions", rays),
                 {},
                 field.all.receivers.count,
                 Rung{rays, errors_of(rival_svf, field.truth)},
                 Rung{rays, errors_of(our_svf, field.truth)}};
  measure(city, field.all, directions, ours, extent.turns, row);
  return {row};
}

void tell(const std::string& what) { fmt::print(stderr, "{}\n", what); }

namespace {

void open_all(const std::filesystem::path& folder) {
  const PackageReader package(folder);
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) static_cast<void>(package.tile(cells.cell_at(n)));
}

SizeRow study_size(const SizedCity& sized, const OurEngine& ours, Accuracy accuracy, const Extent& extent) {
  const City city(sized.package);
  const PackageReader& package = city.package;
  tell("a city of " + std::to_string(package.manifest().polygons) + " polygons");
  const std::vector<Cell> cells = spread_cells(package.grid(), extent.cells);
  const CityReceivers receivers = place_receivers(package, cells, Place::ground, extent.spacing_m(Place::ground));
  const std::vector<SharedPacket> packets = packets_of(package.grid(), receivers);
  SizeRow row;
  row.polygons = package.manifest().polygons;
  row.triangles = city.triangles.triangles.size();
  row.index_bytes = city.rival.index_bytes();
  row.receivers = receivers.count;
  row.all_receivers =
      static_cast<double>(receivers.count) * static_cast<double>(package.grid().cells.size()) / static_cast<double>(cells.size());
  row.pack_s = sized.pack_s;
  row.open_s = median_seconds(extent.turns, [&] { open_all(sized.package); });
  row.build_s = median_seconds(extent.turns, [&] { static_cast<void>(WholeCityRival(city.triangles)); });
  std::vector<float> svf(receivers.count);
  const std::vector<Point3d> directions = fibonacci_directions(accuracy.rival_rays);
  const Duel result = duel(
      extent.turns, [&] { evaluate(package, ours.settings(accuracy.our_samples), receivers, svf); },
      [&] { city.rival.evaluate(packets, directions, svf); });
  row.ours_s = result.first_s;
  row.rival_s = result.second_s;
  row.ratio = result.ratio;
  return row;
}

}  // namespace

std::optional<double> SizeRow::break_even() const {
  const double gained_s_each = rival_s_each() - ours_s_each();
  if (gained_s_each <= 0.0) return std::nullopt;
  return std::max(0.0, (pack_s + open_s - build_s) / gained_s_each);
}

std::vector<SizeRow> study_sizes(std::span<const SizedCity> cities, const OurEngine& ours, Accuracy accuracy,
                                 const Extent& extent) {
  std::vector<SizeRow> rows;
  for (const SizedCity& city : cities) rows.push_back(study_size(city, ours, accuracy, extent));
  return rows;
}

}  // namespace farlod::benchmark
