// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/weather.hpp"
#include "weather/light_of_weather.hpp"
#include "weather/weather.hpp"

namespace farlod {
namespace {

void check(const LightSource& source, const PlaceOnEarth& place) {
  constexpr std::chrono::minutes shortest{1}, longest{60};
  if (source.step < shortest || source.step > longest)
    throw InvalidArgument("a step of the sun is " + std::to_string(source.step.count()) + " minutes: give 1 to 60");
  if (!(std::abs(place.latitude.degrees()) <= 90.0) || !(std::abs(place.longitude.degrees()) <= 360.0) ||
      !std::isfinite(place.height_m))
    throw InvalidArgument("a place on the Earth has a latitude from -90 to 90° and a longitude from -360 to 360°");
  if (source.weather_file.empty() && source.period.empty())
    throw InvalidArgument("light needs a file of weather, or the period of a clear sky: give one of the two");
}

Weather weather_of(const LightSource& source, const PlaceOnEarth& place) {
  std::optional<Period> period;
  if (!source.period.empty()) period = period_in(source.period);
  if (source.weather_file.empty()) return clear_sky_weather(place, *period, source.step, source.linke_turbidity);
  Weather weather = read_weather(source.weather_file, place);
  return period ? within(weather, *period) : weather;
}

double global_horizontal_wh_m2(const LightInterval& interval) {
  double hours = 0.0, sine_hours = 0.0;
  for (const SunPosition& sun : interval.sun) {
    hours += sun.hours;
    sine_hours += sun.hours * std::sin(sun.elevation.radians());
  }
  const double mean_sine = hours > 0.0 ? sine_hours / hours : 0.0;
  return (interval.diffuse_w_m2 + mean_sine * interval.direct_normal_w_m2) * interval.hours;
}

}  // namespace

double global_horizontal_kwh_m2(std::span<const LightInterval> intervals) {
  double wh_m2 = 0.0;
  for (const LightInterval& interval : intervals) wh_m2 += global_horizontal_wh_m2(interval);
  return wh_m2 / 1000.0;
}

PeriodLight light_of_period(const LightSource& source, const PlaceOnEarth& place) {
  check(source, place);
  Weather weather = weather_of(source, place);
  // What fell at the place of the weather came from the sun that it has there
  LightOfWeather light = light_of(weather, weather.place.value_or(place), source.step);
  PeriodLight period{std::move(light.intervals), std::move(weather.source), 0.0, 0.0, std::move(weather.remarks)};
  std::chrono::milliseconds duration{};
  for (const WeatherInterval& interval : weather.intervals) duration += interval.duration;
  period.hours = std::chrono::duration<double, std::chrono::hours::period>(duration).count();
  period.global_horizontal_kwh_m2 = global_horizontal_kwh_m2(period.intervals);
  for (std::string& remark : light.remarks) period.remarks.push_back(std::move(remark));
  return period;
}

}  // namespace farlod
