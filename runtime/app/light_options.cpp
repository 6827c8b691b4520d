// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/light_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <utility>

#include "app/word_choice.hpp"
#include "console/option_list.hpp"
#include "console/wrong_usage.hpp"
#include "farlod/error.hpp"
#include "weather/period.hpp"

namespace farlod {
namespace {

constexpr const char* group_of_light = "Sun and sky";

/// "0.2,0.3": the ground, and façades.
void set_albedo(const std::string& text, Light& light) {
  if (text.empty()) return;
  const char* const end = text.data() + text.size();
  const auto ground = std::from_chars(text.data(), end, light.ground_albedo);
  const bool has_comma = ground.ec == std::errc() && ground.ptr != end && *ground.ptr == ',';
  const auto facade = std::from_chars(has_comma ? ground.ptr + 1 : end, end, light.facade_albedo);
  const auto is_share = [](double albedo) { return 0.0 <= albedo && albedo <= 1.0; };
  if (!has_comma || facade.ec != std::errc() || facade.ptr != end || !is_share(light.ground_albedo) ||
      !is_share(light.facade_albedo))
    throw CLI::ValidationError("--albedo", "\"" + text + "\" is not two numbers from 0 to 1 with a comma, like 0.2,0.3");
}

void check_period(const std::string& text) {
  if (text.empty()) return;
  try {
    (void)period_in(text);
  } catch (const InvalidArgument& error) {
    throw CLI::ValidationError("--period", error.what());
  }
}

/// The first of the options that are given; null where none is.
const char* given_option(const RawLight& raw) {
  const std::array<std::pair<const char*, bool>, 7> options{{{"--weather", !raw.weather_file.empty()},
                                                             {"--period", !raw.period.empty()},
                                                             {"--step", raw.step_minutes > 0},
                                                             {"--linke", raw.linke_turbidity.has_value()},
                                                             {"--sky-model", raw.sky_model != "perez"},
                                                             {"--albedo", !raw.albedo.empty()},
                                                             {"--by", !raw.by.empty()}}};
  const auto* const given = std::ranges::find_if(options, [](const auto& option) { return option.second; });
  return given == options.end() ? nullptr : given->first;
}

void require_fitting(const RawLight& raw, const Quantities& q) {
  if (!q.any_of_light()) {
    if (const char* const option = given_option(raw))
      throw CLI::ValidationError(option, "it goes with --quantity irradiation, irradiance, illuminance or shade");
    return;
  }
  if (raw.weather_file.empty() && raw.period.empty())
    throw CLI::ValidationError("--quantity",
                               "irradiation, irradiance, illuminance and shade are those of a period: give --weather, a file of "
                               "it, or --period, of which the sky is clear then");
  if (!raw.weather_file.empty() && raw.linke_turbidity)
    throw CLI::ValidationError("--linke", "it is that of a clear sky: leave it or --weather out");
  if (raw.by == "month" && !q.irradiation) throw CLI::ValidationError("--by", "month goes with --quantity irradiation");
  if (raw.by == "step" && !q.shade) throw CLI::ValidationError("--by", "step goes with --quantity shade");
}

void add_times(CLI::App& app, RawLight& raw) {
  app.add_option("--step", raw.step_minutes, "Minutes from one position of the sun to the next, and of a clear sky (default: 5)")
      ->check(between(1, 60))
      ->group(group_of_light);
  app.add_option("--by", raw.by, "month: irradiation of each month, too; step: shade of each --step, or row of the weather")
      ->check(one_of_words({"month", "step"}))
      ->group(group_of_light);
}

/// Where light comes from.
void add_source_options(CLI::App& app, RawLight& raw) {
  app.add_option("--weather", raw.weather_file,
                 "Weather for irradiation, irradiance, illuminance and shade: EPW, a TMY of PVGIS or NREL, or a CSV of times and "
                 "global, direct "
                 "and diffuse irradiance. Without it, the sky of --period is clear")
      ->type_name(file_value)
      ->group(group_of_light);
  app.add_option("--period", raw.period,
                 "Part of the weather, as 2026-06-21, 2026-06/08, 2026-06-21T10:00/16:00, or of any year, as 06-21")
      ->group(group_of_light);
  app.add_option("--linke", raw.linke_turbidity,
                 "Linke turbidity of a clear sky: 2 in mountains, 3 in a clear country, 4 to 5 in cities (default: 3)")
      ->check(between(1.0, 12.0))
      ->group(group_of_light);
}

}  // namespace

void add_light_options(CLI::App& app, RawLight& raw, SurfaceSettings& surfaces) {
  add_source_options(app, raw);
  app.add_option("--sky-model", raw.sky_model, "How the light of the sky is spread: perez (all weathers, 1993), or isotropic")
      ->check(one_of(sky_model_words))
      ->capture_default_str()
      ->group(group_of_light);
  app.add_option("--albedo", raw.albedo,
                 "Shares that the ground and facades reflect, as 0.2,0.2 (default): one bounce, by the share of the view that is "
                 "not sky")
      ->group(group_of_light);
  add_times(app, raw);
  app.add_option(
         "--irradiation-threshold", surfaces.irradiation_threshold_kwh_m2,
         "With --surfaces, in kWh/m²: the tables of surfaces and buildings tell which of their area gets at least so much")
      ->check(between(0.0, 100000.0))
      ->group(group_of_light);
}

std::optional<LightSource> resolved_light(const RawLight& raw, Quantities& quantities) {
  require_fitting(raw, quantities);
  if (!quantities.any_of_light()) return std::nullopt;
  Light& light = quantities.light.emplace();
  light.sky_model = *value_of(sky_model_words, raw.sky_model);
  light.by_month = raw.by == "month";
  light.by_step = raw.by == "step";
  set_albedo(raw.albedo, light);
  check_period(raw.period);
  LightSource source{.weather_file = raw.weather_file, .period = raw.period};
  if (raw.step_minutes > 0) source.step = std::chrono::minutes(static_cast<std::int64_t>(raw.step_minutes));
  if (raw.linke_turbidity) source.linke_turbidity = *raw.linke_turbidity;
  return source;
}

}  // namespace farlod
