// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/light_of_package.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "app/sun_of_package.hpp"
#include "farlod/error.hpp"
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

/// A day of five minutes.
constexpr std::ptrdiff_t most_steps = 288;

void require_few_steps(const Light& light) {
  const auto steps = std::count_if(light.intervals.begin(), light.intervals.end(), has_sun);
  if (light.by_step && steps > most_steps)
    throw InputError(
        fmt::format("--by step would make {} columns of shade, more than {}: take a shorter --period, or a longer "
                    "--step of a clear sky.",
                    steps, most_steps));
}

/// Rows that lack it are left out of the mean.
void require_illuminance(const Light& light, std::vector<std::string>& remarks) {
  const auto known = static_cast<std::size_t>(
      std::ranges::count_if(light.intervals, [](const LightInterval& i) { return i.diffuse_lux.has_value(); }));
  if (known == 0)
    throw InputError("The weather has no illuminance that can be true: leave illuminance out, or give an EPW or TMY3 with it.");
  if (known < light.intervals.size())
    remarks.push_back(fmt::format("{} of {} rows of the weather have no illuminance: its mean is that of the others.",
                                  light.intervals.size() - known, light.intervals.size()));
}

}  // namespace

std::vector<std::string> place_light(const Package& package, SvfOptions& options) {
  Quantities& further = options.evaluation.further;
  if (options.sunshine) further.sun = sun_of_package(package.description(), *options.sunshine);
  if (!options.light || !further.light) return {};
  LightOfWeather light = light_at(place_of_package(package.description()), *options.light);
  further.light->intervals = std::move(light.intervals);
  require_few_steps(*further.light);
  if (further.illuminance) require_illuminance(*further.light, light.remarks);
  if (inventory_of(package).crowns.all() > 0)
    light.remarks.emplace_back(
        "Crowns of trees take light, and are the same in all of the period (--leaf-off, --transmissivity).");
  return light.remarks;
}

}  // namespace farlod
