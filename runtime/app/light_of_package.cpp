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

namespace farlod {
namespace {

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

std::optional<PeriodLight> place_light(const Package& package, SvfOptions& options) {
  Quantities& further = options.evaluation.further;
  if (options.sunshine) further.sun = sun_of_package(package.description(), *options.sunshine);
  if (!options.light || !further.light) return std::nullopt;
  PeriodLight light = light_of_period(*options.light, place_of_package(package.description()));
  further.light->intervals = std::move(light.intervals);
  require_few_steps(*further.light);
  if (further.illuminance) require_illuminance(*further.light, light.remarks);
  if (inventory_of(package).crowns.all() > 0)
    light.remarks.emplace_back(
        "Crowns of trees take light, and are the same in all of the period (--leaf-off, --transmissivity).");
  return light;
}

std::vector<std::string> notes_of(const PeriodLight& light) {
  std::vector<std::string> notes{fmt::format("Light of {:.6g} hours: {}.", light.hours, light.source)};
  notes.insert(notes.end(), light.remarks.begin(), light.remarks.end());
  return notes;
}

}  // namespace farlod
