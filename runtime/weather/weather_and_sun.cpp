// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "weather/solar_radiation.hpp"
#include "weather/weather_table.hpp"

namespace farlod {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;

/// So many of the intervals that `choose`, evenly from all: the sun's position takes its time.
template <class Choose>
std::vector<WeatherInterval> sample_of(const std::vector<WeatherInterval>& intervals, std::size_t at_most, const Choose& choose) {
  std::vector<WeatherInterval> chosen;
  std::ranges::copy_if(intervals, std::back_inserter(chosen), choose);
  const std::size_t stride = (chosen.size() + at_most - 1) / at_most;
  if (stride <= 1) return chosen;
  for (std::size_t n = 0; n * stride < chosen.size(); ++n) chosen[n] = chosen[n * stride];
  chosen.resize((chosen.size() + stride - 1) / stride);
  return chosen;
}

std::vector<WeatherInterval> lit_intervals(const std::vector<WeatherInterval>& intervals, std::size_t at_most) {
  constexpr double lit_w_m2 = 20.0;  // more than twilight and the noise of instruments
  return sample_of(intervals, at_most, [](const WeatherInterval& interval) { return interval.global_w_m2 > lit_w_m2; });
}

/// Where the sun is in the middles of intervals, were it so much later.
std::vector<SunDirection> suns_of(const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place, milliseconds shift) {
  std::vector<std::chrono::sys_time<milliseconds>> times;
  for (const WeatherInterval& interval : intervals) times.push_back(interval.middle_utc + shift);
  return sun_directions(place, times);
}

constexpr double twilight_deg = -1.0;

/// Whether the sun stays down at the ends of an interval, too, in whose middle it is.
bool is_night_throughout(const WeatherInterval& interval, const PlaceOnEarth& place) {
  for (const milliseconds after_middle : {-interval.duration / 2, interval.duration / 2})
    if (sun_direction(place, interval.middle_utc + after_middle).elevation.degrees() > twilight_deg) return false;
  return true;
}

/// By how much later the sun of a place would fit best, in whole hours.
hours best_zone_shift(const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place) {
  constexpr std::size_t enough = 100;
  const std::vector<WeatherInterval> lit = lit_intervals(intervals, enough);
  hours best(0);
  double best_sum = -std::numeric_limits<double>::infinity();
  for (hours shift(-14); shift <= hours(14); ++shift) {
    double sum = 0.0;
    const std::vector<SunDirection> suns = suns_of(lit, place, shift);
    for (std::size_t n = 0; n < lit.size(); ++n) sum += lit[n].global_w_m2 * sin(suns[n].elevation);
    if (sum <= best_sum) continue;
    best = shift;
    best_sum = sum;
  }
  return best;
}

std::string clock_time_of(const WeatherTable& table, const WeatherInterval& interval) {
  return time_text(ClockTime(interval.middle_utc.time_since_epoch() + table.clock_ahead_of_utc)) + " (" +
         clock_text(table.clock_ahead_of_utc) + ")";
}

void check_nights(WeatherTable& table, const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place,
                  const WeatherText& text) {
  constexpr std::size_t enough = 5000;
  constexpr double largest_share = 0.01;
  double all = 0.0, at_night = 0.0;
  std::optional<WeatherInterval> first;
  const std::vector<WeatherInterval> lit = lit_intervals(intervals, enough);
  const std::vector<SunDirection> suns = suns_of(lit, place, milliseconds(0));
  for (std::size_t n = 0; n < lit.size(); ++n) {
    all += lit[n].global_w_m2;
    if (suns[n].elevation.degrees() > twilight_deg || !is_night_throughout(lit[n], place)) continue;
    if (!first) first = lit[n];
    at_night += lit[n].global_w_m2;
  }
  if (!first) return;
  const std::string night =
      fmt::format("{:.2g} % of the irradiance falls at night at {}, first {:.0f} W/m² around {}", 100.0 * at_night / all,
                  place_text(place), first->global_w_m2, clock_time_of(table, *first));
  if (at_night <= largest_share * all) {
    table.remarks.push_back(text.name() + ": " + night + ".");
    return;
  }
  const auto shift = best_zone_shift(intervals, place).count();
  text.refuse_file(
      night + ": the time zone or the place is wrong" +
      (shift == 0 ? "" : fmt::format("; times {} h {} would fit", std::abs(shift), shift < 0 ? "earlier" : "later")) +
      "; correct them");
}

/// The share of global irradiance by which it differs from what direct and diffuse make of it, were the sun where it is so much
/// later.
double mismatch_of(const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place, minutes shift) {
  double all = 0.0, off = 0.0;
  const std::vector<SunDirection> suns = suns_of(intervals, place, shift);
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const double sine = std::max(0.0, sin(suns[n].elevation));
    all += intervals[n].global_w_m2;
    off += std::abs(intervals[n].global_w_m2 - intervals[n].direct_normal_w_m2 * sine - intervals[n].diffuse_w_m2);
  }
  return all > 0.0 ? off / all : 0.0;
}

/// The same, were direct irradiance that of a level plane.
double level_mismatch_of(const std::vector<WeatherInterval>& intervals) {
  double all = 0.0, off = 0.0;
  for (const WeatherInterval& interval : intervals) {
    all += interval.global_w_m2;
    off += std::abs(interval.global_w_m2 - interval.direct_normal_w_m2 - interval.diffuse_w_m2);
  }
  return all > 0.0 ? off / all : 0.0;
}

/// Times at which the sun's sine in the middle of an hour is its mean.
std::vector<WeatherInterval> sunny_intervals(const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place) {
  constexpr std::size_t enough = 400;
  constexpr double sunny_w_m2 = 50.0, high_deg = 10.0;
  const std::vector<WeatherInterval> sunny =
      sample_of(intervals, enough, [](const WeatherInterval& interval) { return interval.direct_normal_w_m2 > sunny_w_m2; });
  const std::vector<SunDirection> suns = suns_of(sunny, place, milliseconds(0));
  std::vector<WeatherInterval> high;
  for (std::size_t n = 0; n < sunny.size(); ++n)
    if (suns[n].elevation.degrees() > high_deg) high.push_back(sunny[n]);
  return high;
}

void check_parts(WeatherTable& table, const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place) {
  constexpr double tolerable = 0.03, intolerable = 0.1, clearly_better = 0.5;
  const std::vector<WeatherInterval> sunny = sunny_intervals(intervals, place);
  const double now = mismatch_of(sunny, place, minutes(0));
  if (now < tolerable) return;
  const std::string mismatch =
      fmt::format("Global irradiance differs from direct and diffuse by {:.0f} % on average", 100.0 * now);
  if (level_mismatch_of(sunny) < clearly_better * now) {
    table.remarks.push_back(mismatch + ": direct seems to be that of a level plane; give that of a plane that faces the sun.");
    return;
  }
  minutes best(0);
  double least = now;
  for (const int shift : {-60, -45, -30, -15, 15, 30, 45, 60})
    if (const double then = mismatch_of(sunny, place, minutes(shift)); then < least) {
      best = minutes(shift);
      least = then;
    }
  if (least < clearly_better * now)
    table.remarks.push_back(
        fmt::format("{}, and by {:.0f} % were its times {} min {}: they may be those of another part of their "
                    "intervals than is taken.",
                    mismatch, 100.0 * least, std::abs(best.count()), best.count() < 0 ? "earlier" : "later"));
  else if (now > intolerable)
    table.remarks.push_back(mismatch + ": the place may be another, or one of the three wrong.");
}

/// Degrees of a great circle.
double distance_deg(const PlaceOnEarth& a, const PlaceOnEarth& b) {
  const double cosine = sin(a.latitude) * sin(b.latitude) + cos(a.latitude) * cos(b.latitude) * cos(a.longitude - b.longitude);
  return Angle::radians(std::acos(std::clamp(cosine, -1.0, 1.0))).degrees();
}

}  // namespace

void check_place(WeatherTable& table, const PlaceOnEarth& city) {
  constexpr double far_deg = 2.0, km_a_degree = 111.2;
  if (!table.place) return;
  const double apart = distance_deg(*table.place, city);
  if (apart <= far_deg) return;
  table.remarks.push_back(fmt::format("The weather is that of {}, {:.0f} km from the city at {}.", place_text(*table.place),
                                      apart * km_a_degree, place_text(city)));
}

void check_with_sun(WeatherTable& table, const std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place,
                    const WeatherText& text) {
  check_nights(table, intervals, place, text);
  check_parts(table, intervals, place);
}

}  // namespace farlod
