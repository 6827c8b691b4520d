// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/contest.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "benchmark/measurement.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/verification.hpp"

namespace farlod::benchmark {
namespace {

std::vector<Rung> climb_rival(const City& city, const Field& field, const Extent& extent) {
  const Answer answer = [&](std::size_t rays) {
    std::vector<float> svf(field.sample.count);
    city.rival.evaluate(field.sample_packets, fibonacci_directions(rays), svf);
    return svf;
  };
  return climb(extent.rival_ladder, answer, field.truth);
}

std::vector<float> our_answers(const City& city, const Field& field, const OurEngine& ours, std::size_t samples) {
  const CityReceivers& asked = ours.shares_work ? field.receivers : field.sample;
  std::vector<float> svf(asked.count);
  evaluate(city.package, ours.settings(samples), asked, svf);
  if (!ours.shares_work) return svf;
  std::vector<float> of_sample;
  for (const std::size_t n : field.sample_in_all) of_sample.push_back(svf[n]);
  return of_sample;
}

std::vector<Rung> climb_ours(const City& city, const Field& field, const OurEngine& ours) {
  const Answer answer = [&](std::size_t samples) { return our_answers(city, field, ours, samples); };
  return climb(ours.ladder, answer, field.truth);
}

double spacing_of(Place place, const Extent& extent) {
  return place == Place::ground ? extent.ground_spacing_m : extent.surface_spacing_m;
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
  extent.ground_spacing_m = 4.0;
  extent.surface_spacing_m = 6.0;
  return extent;
}

Field prepare_field(const City& city, Place place, const Extent& extent) {
  const double spacing_m = spacing_of(place, extent);
  Field field;
  field.place = place;
  field.receivers = place_receivers(city.package, spread_cells(city.package.grid(), extent.cells), place, spacing_m);
  field.sample = choose_receivers(field.receivers, extent.sample);
  field.sample_in_all = choose_some(field.receivers.count, extent.sample);
  field.packets = packets_of(city.package.grid(), field.receivers);
  field.sample_packets = packets_of(city.package.grid(), field.sample);
  field.truth = exact_answers(city.package, field.sample, extent.truth_rays);
  return field;
}

Contest contest(const City& city, Place place, const OurEngine& ours, const Extent& extent) {
  tell(fmt::format("{}: errors", name_of(place)));
  const Field field = prepare_field(city, place, extent);
  Contest result{
      place, field.sample.count, field.receivers.placing_s, climb_rival(city, field, extent), climb_ours(city, field, ours), {}};
  for (const double target : extent.targets) {
    tell(fmt::format("{}: time at a largest error of {:.3f}", name_of(place), target));
    ContestRow row{fmt::format("{} every {:g} m, max error ≤ {:.3f}", name_of(place), spacing_of(place, extent), target),
                   field.receivers.count, rung_within(result.rival_ladder, target), rung_within(result.our_ladder, target)};
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
  const Field field = prepare_field(city, Place::ground, extent);
  const SkySettings ours = engine_named("rays").settings(rays);
  const SkyDirections all(ours.weight, rays, city.package.grid().rotation);
  const std::vector<Point3d> directions(all.facing_up().begin(), all.facing_up().end());
  std::vector<float> our_svf(field.sample.count), rival_svf(our_svf);
  evaluate(city.package, ours, field.sample, our_svf);
  city.rival.evaluate(field.sample_packets, directions, rival_svf);
  ContestRow row{fmt::format("overhangs, ground, engine `rays`, the same {} directions", rays), field.receivers.count,
                 Rung{rays, errors_of(rival_svf, field.truth)}, Rung{rays, errors_of(our_svf, field.truth)}};
  measure(city, field, directions, ours, extent.turns, row);
  return {row};
}

void tell(const std::string& what) { fmt::print(stderr, "{}\n", what); }

}  // namespace farlod::benchmark
