// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/answered_points.hpp"
#include "app/named_points.hpp"
#include "app/quantity_options.hpp"
#include "app/sun_of_package.hpp"
#include "app/written_run.hpp"
#include "farlod/error.hpp"
#include "farlod/hemisphere.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/sky_picture.hpp"

namespace farlod {
namespace {

/// A further value of the place that is looked up from, if it was asked for.
std::optional<float> value_of(const Hemisphere& hemisphere, const SvfOptions& options, std::string_view column) {
  const std::vector<std::string> columns = columns_of(options.evaluation.further);
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return std::nullopt;
  return hemisphere.further.at(static_cast<std::size_t>(found - columns.begin()));
}

/// The sun's way, and for how long it shines here.
std::optional<SunOfSky> sun_of_sky(const Package& package, const SvfOptions& options, const Hemisphere& hemisphere) {
  if (!options.sunshine) return std::nullopt;
  SunOfSky sun = sun_courses_of_package(package.description(), *options.sunshine);
  const char* const period = options.sunshine->days == 1 ? "that day" : "in the year";
  sun.legend.push_back(fmt::format("Sunshine {}:", period));
  sun.legend.push_back(fmt::format("{:.1f} h, were the sky clear", *value_of(hemisphere, options, "sunlit_h")));
  if (const auto hours = value_of(hemisphere, options, "sunlit_total_h"))
    sun.legend.push_back(fmt::format("{:.1f} h with trees", *hours));
  return sun;
}

/// Whole intervals of some hours, so that a picture of a year has some thousand suns.
constexpr double hours_between_suns = 1.0;

/// The suns of a period: one for each interval, or of the shorter ones one an hour, where the period has more than three days.
std::vector<LitSun> suns_of(const Light& light) {
  constexpr double hours_with_each_sun = 72.0;
  double all_hours = 0.0, since_last = hours_between_suns;
  for (const LightInterval& interval : light.intervals) all_hours += interval.hours;
  std::vector<LitSun> suns;
  for (const LightInterval& interval : light.intervals) {
    // Half a second: hours are sums of steps
    const bool is_next = all_hours <= hours_with_each_sun || since_last > hours_between_suns - 0.5 / 3600.0;
    if (is_next && !interval.sun.empty()) {
      const SunPosition& sun = interval.sun[interval.sun.size() / 2];
      suns.push_back({{sun.azimuth.degrees(), 90.0 - sun.elevation.degrees()}, interval.direct_normal_w_m2});
    }
    since_last = (is_next ? 0.0 : since_last) + interval.hours;
  }
  return suns;
}

/// Where the sun stands in the period, and what falls on the receiver.
std::optional<LightOfSky> light_of_sky(const SvfOptions& options, const Hemisphere& hemisphere) {
  const Quantities& further = options.evaluation.further;
  if (!further.light) return std::nullopt;
  LightOfSky light{suns_of(*further.light), {"Irradiation in kWh/m²:"}};
  constexpr std::array<std::pair<const char*, const char*>, 4> columns{{{"irradiation", "in all"},
                                                                        {"irradiation_direct", "direct"},
                                                                        {"irradiation_diffuse", "diffuse"},
                                                                        {"irradiation_reflected", "reflected"}}};
  for (const auto& [column, word] : columns)
    light.legend.push_back(fmt::format("{:#.4g} {}", *value_of(hemisphere, options, column), word));
  return light;
}

[[noreturn]] void refuse_sky(const Package& package, const NamedPoints& named, const SvfOptions& options, std::size_t threads) {
  PointAnswers none;
  none.svf = {std::numeric_limits<float>::quiet_NaN()};
  require_answers_of_points(named, reasons_of_unanswered(package, named, none, threads), none, options, package.description());
  throw NoAnswer("There is no sky to draw: choose another place.");
}

}  // namespace

WrittenRun write_sky(const Package& package, const SvfOptions& options, const RunSettings& run) {
  const NamedPoints named = requested_points(options, package.description());
  require_any_in_reach(named, options, package.description());
  const Point2d place{named.x_m.front(), named.y_m.front()};
  const std::string coordinates = fmt::format("{:.2f}, {:.2f}", place.x, place.y);
  const auto hemisphere = look_up(package, place, options.at.z, options.placing, options.evaluation, run);
  if (!hemisphere) refuse_sky(package, named, options, run.threads);
  const PackageDescription& city = package.description();
  const std::string crs = city.epsg ? "EPSG:" + std::to_string(*city.epsg) : city.crs_name;
  const SkyCaption caption{quantity_name(options.evaluation.weight),
                           fmt::format("{} ({}), z = {:.2f} m", coordinates, crs, hemisphere->height_m),
                           value_of(*hemisphere, options, "svf_total")};
  WrittenRun written{hemisphere->summary, {options.output}};
  written.notes = named.notes;
  const std::optional<SunOfSky> sun = sun_of_sky(package, options, *hemisphere);
  const std::optional<LightOfSky> light = light_of_sky(options, *hemisphere);
  written.write_s =
      seconds_of([&] { write_drawing(draw_sky(*hemisphere, options.projection, caption, sun, light), options.output); });
  return written;
}

}  // namespace farlod
