// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/light_of_weather.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <utility>

#include "base/expects.hpp"
#include "weather/solar_radiation.hpp"

namespace farlod {
namespace {

using std::chrono::milliseconds;

constexpr double milliseconds_in_hour = 3'600'000.0;

/// The air of a time in which the sun is refracted: between 0 and 30 °C the sun at the horizon moves by .06°.
Atmosphere mean_air(const Weather& weather) {
  Atmosphere air{0.0, 0.0};
  for (const WeatherInterval& w : weather.intervals) {
    air.pressure_hpa += w.pressure_hpa / static_cast<double>(weather.intervals.size());
    air.temperature_c += w.temperature_c / static_cast<double>(weather.intervals.size());
  }
  return air;
}

milliseconds::rep steps_of(const WeatherInterval& weather, milliseconds step) {
  return std::max<milliseconds::rep>(1, (weather.duration + step - milliseconds(1)) / step);
}

/// Where the sun is in the middles of all steps of all intervals.
std::vector<SunDirection> sun_of_steps(const Weather& weather, const PlaceOnEarth& place, milliseconds step) {
  std::vector<std::chrono::sys_time<milliseconds>> times;
  for (const WeatherInterval& w : weather.intervals) {
    const auto count = steps_of(w, step);
    for (milliseconds::rep n = 0; n < count; ++n)
      times.push_back(w.middle_utc - w.duration / 2 + w.duration * (2 * n + 1) / (2 * count));
  }
  return sun_directions(place, times, mean_air(weather));
}

LightInterval interval_of(const WeatherInterval& weather, std::span<const SunDirection> steps) {
  LightInterval interval;
  interval.hours = static_cast<double>(weather.duration.count()) / milliseconds_in_hour;
  for (const SunDirection& sun : steps)
    if (sun.elevation.radians() > 0.0)
      interval.sun.push_back({sun.azimuth, sun.elevation, interval.hours / static_cast<double>(steps.size())});
  interval.direct_normal_w_m2 = weather.direct_normal_w_m2;
  interval.diffuse_w_m2 = weather.diffuse_w_m2;
  interval.direct_normal_lux = weather.direct_normal_lux;
  interval.diffuse_lux = weather.diffuse_lux;
  interval.extraterrestrial_w_m2 = extraterrestrial_w_m2(weather.middle_utc);
  return interval;
}

}  // namespace

LightOfWeather light_of(const Weather& weather, const PlaceOnEarth& place, milliseconds step) {
  FARLOD_EXPECTS(step.count() > 0);
  LightOfWeather light;
  const std::vector<SunDirection> sun = sun_of_steps(weather, place, step);
  std::span<const SunDirection> left = sun;
  double direct_at_night = 0.0;
  for (const WeatherInterval& w : weather.intervals) {
    const auto count = static_cast<std::size_t>(steps_of(w, step));
    LightInterval interval = interval_of(w, left.first(count));
    left = left.subspan(count);
    interval.month = static_cast<unsigned>(month_of(weather, w));
    interval.begin = std::chrono::floor<std::chrono::seconds>(
        ClockTime((w.middle_utc - w.duration / 2).time_since_epoch() + weather.clock_ahead_of_utc));
    if (interval.sun.empty()) direct_at_night += interval.direct_normal_w_m2 * interval.hours / 1000.0;
    light.intervals.push_back(std::move(interval));
  }
  constexpr double worth_telling_kwh_m2 = 0.5;
  if (direct_at_night > worth_telling_kwh_m2)
    light.remarks.push_back(
        fmt::format("{:.1f} kWh/m² of direct light at times with the sun below the horizon were left out: check "
                    "the time zone and the place of the weather.",
                    direct_at_night));
  return light;
}

}  // namespace farlod
