// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/light_of_package.hpp"

#include <fmt/core.h>

#include <utility>

#include "app/sun_of_package.hpp"
#include "farlod/inspection.hpp"
#include "weather/light_of_weather.hpp"
#include "weather/weather.hpp"

namespace farlod {
namespace {

Weather weather_of(const LightRequest& request, const PlaceOnEarth& place) {
  if (request.weather_file.empty()) return clear_sky_weather(place, *request.period, request.step, request.linke_turbidity);
  Weather weather = read_weather(request.weather_file, place);
  return request.period ? within(weather, *request.period) : weather;
}

/// The light over a place, and what users should know of it.
LightOfWeather light_at(const PlaceOnEarth& place, const LightRequest& request) {
  const Weather weather = weather_of(request, place);
  // What fell at the place of the weather came from the sun that it has there
  LightOfWeather light = light_of(weather, weather.place.value_or(place), request.step);
  double hours = 0.0;
  for (const LightInterval& interval : light.intervals) hours += interval.hours;
  light.remarks.insert(light.remarks.begin(), weather.remarks.begin(), weather.remarks.end());
  light.remarks.insert(light.remarks.begin(), fmt::format("Light of {:.6g} hours: {}.", hours, weather.source));
  return light;
}

}  // namespace

std::vector<std::string> place_light(const Package& package, SvfOptions& options) {
  Quantities& further = options.evaluation.further;
  if (options.sunshine) further.sun = sun_of_package(package.description(), *options.sunshine);
  if (!options.light || !further.light) return {};
  LightOfWeather light = light_at(place_of_package(package.description()), *options.light);
  further.light->intervals = std::move(light.intervals);
  if (inventory_of(package).crowns.all() > 0)
    light.remarks.emplace_back("Trees are left out of irradiation, irradiance and shade: all light passes their crowns.");
  return light.remarks;
}

}  // namespace farlod
