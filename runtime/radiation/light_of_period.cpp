// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/light_of_period.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <ratio>
#include <span>
#include <utility>

namespace farlod {
namespace {

/// What counts of an interval: on a plane that faces the sun, and of the sky on a level plane.
struct Amounts {
  double direct_normal, diffuse;
};
using Measure = Amounts (*)(const LightInterval& interval);
Amounts in_kwh_m2(const LightInterval& interval) {
  return {energy_kwh_m2(interval.direct_normal_w_m2, interval.hours), energy_kwh_m2(interval.diffuse_w_m2, interval.hours)};
}
Amounts in_lux_hours(const LightInterval& interval) {
  return {interval.direct_normal_lux.value_or(0.0) * interval.hours, interval.diffuse_lux.value_or(0.0) * interval.hours};
}

auto end_of(const LightInterval& interval) {
  return interval.begin +
         std::chrono::round<std::chrono::seconds>(std::chrono::duration<double, std::ratio<3600>>(interval.hours));
}

/// Those of intervals, where the sun is up.
std::vector<SunLight> suns_of(std::span<const LightInterval* const> intervals, Measure measure) {
  std::vector<SunLight> suns;
  const LightInterval* before = nullptr;
  for (const LightInterval* const interval : intervals) {
    double hours_of_sun = 0.0;
    for (const SunPosition& sun : interval->sun) hours_of_sun += sun.elevation.radians() > 0.0 ? sun.hours : 0.0;
    if (!(hours_of_sun > 0.0)) continue;
    const double energy = measure(*interval).direct_normal;
    bool goes_on = before != nullptr && interval->begin == end_of(*before);
    for (const SunPosition& sun : interval->sun) {
      if (sun.elevation.radians() <= 0.0) continue;
      suns.push_back({sun, energy * sun.hours / hours_of_sun, goes_on});
      goes_on = true;
    }
    before = interval;
  }
  return suns;
}

/// The sky of some intervals.
struct SkyOfIntervals {
  LightInterval mean;
  double diffuse = 0.0;  ///< what counts of it, on a level plane
};

/// Adds an interval that follows.
void add_interval(const LightInterval& interval, double diffuse, SkyOfIntervals& sky) {
  LightInterval& mean = sky.mean;
  const double hours = mean.hours + interval.hours, share = hours > 0.0 ? interval.hours / hours : 0.0;
  mean.direct_normal_w_m2 += share * (interval.direct_normal_w_m2 - mean.direct_normal_w_m2);
  mean.diffuse_w_m2 += share * (interval.diffuse_w_m2 - mean.diffuse_w_m2);
  mean.extraterrestrial_w_m2 += share * (interval.extraterrestrial_w_m2 - mean.extraterrestrial_w_m2);
  mean.hours = hours;
  mean.sun.insert(mean.sun.end(), interval.sun.begin(), interval.sun.end());
  sky.diffuse += diffuse;
}

/// Whether an interval follows a sky, by day, and is with it no longer than a quarter of an hour.
bool goes_on(const SkyOfIntervals& sky, const LightInterval& interval) {
  constexpr double longest_h = 0.25 + 1e-6;
  return interval.begin == end_of(sky.mean) && sky.mean.hours + interval.hours <= longest_h && has_sun(sky.mean) &&
         has_sun(interval);
}

/// The skies of intervals, those of a quarter of an hour together: steps of minutes are too fine for the bins of the grid, which
/// the sun takes ten minutes to pass.
std::vector<SkyOfIntervals> skies_of(std::span<const LightInterval* const> intervals, Measure measure) {
  std::vector<SkyOfIntervals> skies;
  for (const LightInterval* const interval : intervals) {
    const double diffuse = measure(*interval).diffuse;
    if (!skies.empty() && goes_on(skies.back(), *interval))
      add_interval(*interval, diffuse, skies.back());
    else
      skies.push_back({*interval, diffuse});
  }
  return skies;
}

/// The skies of some intervals by several threads: so many pieces are added up in their order, whoever made them.
SkyGrid sky_of(std::span<const LightInterval* const> intervals, SkyModel model, Measure measure) {
  const std::vector<SkyOfIntervals> skies = skies_of(intervals, measure);
  constexpr std::size_t pieces = 16;
  std::vector<SkyGrid> of_pieces(pieces);
  const auto add_piece = [&](std::size_t n) {
    const std::size_t begin = n * skies.size() / pieces, end = (n + 1) * skies.size() / pieces;
    for (const SkyOfIntervals& sky : std::span(skies).subspan(begin, end - begin)) of_pieces[n].add(sky.mean, model, sky.diffuse);
  };
  // A table may be made in the midst of a cell, for all cells: a thread that waits here must not begin another cell
  oneapi::tbb::this_task_arena::isolate([&] { oneapi::tbb::parallel_for(std::size_t{0}, pieces, add_piece); });
  SkyGrid all = std::move(of_pieces.front());
  for (const SkyGrid& piece : std::span(of_pieces).subspan(1)) all.add(piece);
  return all;
}

SunAndSky sun_and_sky_of(const Light& light, Measure measure, const auto& wanted) {
  std::vector<const LightInterval*> intervals;
  for (const LightInterval& interval : light.intervals)
    if (wanted(interval)) intervals.push_back(&interval);
  return {suns_of(intervals, measure), sky_of(intervals, light.sky_model, measure)};
}

}  // namespace

std::vector<unsigned> months_by_name(const Light& light) {
  std::vector<unsigned> months;
  if (!light.by_month) return months;
  for (const LightInterval& interval : light.intervals) months.push_back(interval.month);
  std::sort(months.begin(), months.end());
  months.erase(std::unique(months.begin(), months.end()), months.end());
  return months;
}

LightOfPeriod::LightOfPeriod(const Light& light, bool with_illuminance) : months(months_by_name(light)) {
  for (const LightInterval& interval : light.intervals) {
    hours += interval.hours;
    hours_of_illuminance += interval.diffuse_lux ? interval.hours : 0.0;
  }
  if (months.empty()) energy.push_back(sun_and_sky_of(light, in_kwh_m2, [](const LightInterval&) { return true; }));
  for (const unsigned month : months)
    energy.push_back(sun_and_sky_of(light, in_kwh_m2, [&](const LightInterval& i) { return i.month == month; }));
  if (with_illuminance)
    illuminance = sun_and_sky_of(light, in_lux_hours, [](const LightInterval& i) { return i.diffuse_lux.has_value(); });
}

}  // namespace farlod
