// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "weather/solar_radiation.hpp"
#include "weather/weather_table.hpp"

namespace farlod {
namespace {

/// What no sky has: for the sun of 1,400 W/m² above the air. Clouds beside the sun add to global irradiance for minutes.
constexpr double largest_direct_w_m2 = 1400.0, largest_global_w_m2 = 2000.0;
/// Codes for nothing known are at these values or beyond: −99 to −99,999; 9,999 and more.
constexpr double lowest_code = -99.0, highest_code = 9999.0;
/// Pyranometers lose heat to a clear sky at night.
constexpr double smallest_offset_w_m2 = -20.0;

/// How many values of a table met something, and where the first did.
struct Tally {
  std::size_t count = 0, first_line = 0;

  void add(std::size_t line) {
    if (count++ == 0) first_line = line;
  }
};

/// One of the three irradiances.
struct Irradiance {
  std::optional<double> WeatherRow::*value;
  const char* name;
  double largest_w_m2;
};

constexpr Irradiance irradiances[] = {{&WeatherRow::global_w_m2, "global", largest_global_w_m2},
                                      {&WeatherRow::direct_normal_w_m2, "direct normal", largest_direct_w_m2},
                                      {&WeatherRow::diffuse_w_m2, "diffuse", largest_direct_w_m2}};

void clean_irradiance(WeatherRow& row, const Irradiance& kind, Tally& raised, const WeatherText& text) {
  std::optional<double>& value = row.*kind.value;
  if (!value) return;
  if (*value <= lowest_code || *value >= highest_code) {
    value.reset();
  } else if (*value < smallest_offset_w_m2 || *value > kind.largest_w_m2) {
    text.refuse(row.line, fmt::format("a {} irradiance of {} W/m² cannot be; correct it, or write -999 where nothing is known",
                                      kind.name, *value));
  } else if (*value < 0.0) {
    raised.add(row.line);
    value = 0.0;
  }
}

/// What is out of this range is not known.
void keep_between(std::optional<double>& value, double lowest, double highest) {
  if (value && !(lowest <= *value && *value <= highest)) value.reset();
}

/// Twice as much light to the eye as there is in a watt of the sun is none, and so is none of it by day.
bool can_be_lux(double lux, double w_m2) {
  constexpr double most_lux_in_watt = 300.0, dark_w_m2 = 20.0;
  return 0.0 <= lux && lux <= most_lux_in_watt * (w_m2 + dark_w_m2) && (lux > 0.0 || w_m2 < dark_w_m2);
}

void set_illuminance(const WeatherRow& row, WeatherInterval& interval) {
  if (!row.direct_normal_lux || !row.diffuse_lux) return;
  if (!can_be_lux(*row.direct_normal_lux, interval.direct_normal_w_m2) || !can_be_lux(*row.diffuse_lux, interval.diffuse_w_m2))
    return;
  interval.direct_normal_lux = row.direct_normal_lux;
  interval.diffuse_lux = row.diffuse_lux;
}

bool tells_irradiance(const WeatherRow& row) { return row.global_w_m2 || (row.direct_normal_w_m2 && row.diffuse_w_m2); }

void tell_missing_rows(WeatherTable& table, const WeatherText& text) {
  Tally missing;
  for (const WeatherRow& row : table.rows)
    if (!tells_irradiance(row)) missing.add(row.line);
  if (missing.count == table.rows.size()) text.refuse_file("no row has irradiance: all are empty, or codes for nothing known");
  if (missing.count > 0)
    table.remarks.push_back(
        fmt::format("{} of {} rows of {} have no irradiance, the first in line {}: sums are of the others alone.", missing.count,
                    table.rows.size(), text.name(), missing.first_line + 1));
}

/// How the three irradiances of rows came about.
struct Filled {
  Tally direct, diffuse, global, by_erbs;
};

/// Fills what two of the three irradiances tell of the third.
class IrradianceFiller {
 public:
  IrradianceFiller(const std::optional<PlaceOnEarth>& place, const WeatherText& text) : place_(place), text_(text) {}

  void fill(const WeatherRow& row, WeatherInterval& interval) {
    if (row.global_w_m2 && row.direct_normal_w_m2 && row.diffuse_w_m2) return;
    if (row.global_w_m2.value_or(0.0) + row.direct_normal_w_m2.value_or(0.0) + row.diffuse_w_m2.value_or(0.0) == 0.0) return;
    if (!place_)
      text_.refuse(row.line,
                   "the irradiances need the sun to be completed, and the place is not known; give all three, global, "
                   "direct and diffuse");
    const double sine = mean_sine_of_sun(*place_, interval.middle_utc, interval.duration);
    if (!row.global_w_m2)
      fill_global(row, interval, sine);
    else if (row.direct_normal_w_m2)
      fill_diffuse(row, interval, sine);
    else if (row.diffuse_w_m2)
      fill_direct(row, interval, sine, filled_.direct);
    else
      split(row, interval, sine);
  }

  void tell(std::vector<std::string>& remarks, std::size_t rows) const {
    tell(remarks, filled_.global, rows, "global irradiance is missing, and found from direct and diffuse");
    tell(remarks, filled_.diffuse, rows, "diffuse irradiance is missing, and found from global and direct");
    tell(remarks, filled_.direct, rows, "direct irradiance is missing, and found from global and diffuse");
    tell(
        remarks, filled_.by_erbs, rows,
        "global irradiance stands alone: it is split into direct and diffuse after Erbs et al. 1982, which is right for the mean "
        "of many hours, and rough for a single one");
  }

 private:
  void fill_global(const WeatherRow& row, WeatherInterval& interval, double sine) {
    filled_.global.add(row.line);
    interval.global_w_m2 = interval.direct_normal_w_m2 * sine + interval.diffuse_w_m2;
  }
  void fill_diffuse(const WeatherRow& row, WeatherInterval& interval, double sine) {
    filled_.diffuse.add(row.line);
    interval.diffuse_w_m2 = std::max(0.0, interval.global_w_m2 - interval.direct_normal_w_m2 * sine);
  }
  /// Near the horizon a small error of global would be a beam as of no sun: there, all is diffuse.
  static void fill_direct(const WeatherRow& row, WeatherInterval& interval, double sine, Tally& tally) {
    constexpr double least_sine = 0.02;  // of the sun a degree high
    tally.add(row.line);
    interval.direct_normal_w_m2 = 0.0;
    const double beam = std::max(0.0, interval.global_w_m2 - interval.diffuse_w_m2);
    if (sine > least_sine) interval.direct_normal_w_m2 = std::min(beam / sine, extraterrestrial_w_m2(interval.middle_utc));
    interval.diffuse_w_m2 = interval.global_w_m2 - interval.direct_normal_w_m2 * sine;
  }
  void split(const WeatherRow& row, WeatherInterval& interval, double sine) {
    const double above_air = sine * extraterrestrial_w_m2(interval.middle_utc);
    const double clearness = above_air > 0.0 ? interval.global_w_m2 / above_air : 0.0;
    interval.diffuse_w_m2 = interval.global_w_m2 * diffuse_share(clearness);
    fill_direct(row, interval, sine, filled_.by_erbs);
  }
  static void tell(std::vector<std::string>& remarks, const Tally& tally, std::size_t rows, const char* what) {
    if (tally.count > 0)
      remarks.push_back(fmt::format("In {} of {} rows {} (first in line {}).", tally.count, rows, what, tally.first_line + 1));
  }

  const std::optional<PlaceOnEarth>& place_;
  const WeatherText& text_;
  Filled filled_;
};

/// What the air is like, or usual where the row does not say.
void set_air(const WeatherRow& row, WeatherInterval& interval, double usual_pressure_hpa) {
  constexpr double usual_humidity_percent = 60.0;
  interval.temperature_c = row.temperature_c.value_or(interval.temperature_c);
  interval.pressure_hpa = row.pressure_hpa.value_or(usual_pressure_hpa);
  const double from_humidity = dew_point_c(interval.temperature_c, row.humidity_percent.value_or(usual_humidity_percent));
  interval.dew_point_c = row.dew_point_c.value_or(from_humidity);
}

void tell_usual_air(WeatherTable& table) {
  const auto lacks = [&](auto&& has) { return static_cast<std::size_t>(std::ranges::count_if(table.rows, std::not_fn(has))); };
  const std::size_t temperature = lacks([](const WeatherRow&row) { return row.temperature_c.has_value(); }),
                    dew_point = lacks([](const WeatherRow&row) { return row.dew_point_c || row.humidity_percent; });
  if (temperature > 0)
    table.remarks.push_back(fmt::format("{} of {} rows have no temperature: 15 °C is taken.", temperature, table.rows.size()));
  if (dew_point > 0)
    table.remarks.push_back(
        fmt::format("{} of {} rows have no dew point or humidity: 60 % is taken.", dew_point, table.rows.size()));
}

}  // namespace

void clean_values(WeatherTable& table, const WeatherText& text) {
  Tally raised;
  for (WeatherRow& row : table.rows) {
    for (const Irradiance& kind : irradiances) clean_irradiance(row, kind, raised, text);
    keep_between(row.temperature_c, -90.0, 60.0);
    keep_between(row.dew_point_c, -98.0, 60.0);
    keep_between(row.humidity_percent, 1.0, 110.0);
    keep_between(row.pressure_hpa, 300.0, 1100.0);
  }
  if (raised.count > 0)
    table.remarks.push_back(fmt::format("{} irradiances are a little below 0, the first in line {}: 0 is taken.", raised.count,
                                        raised.first_line + 1));
  tell_missing_rows(table, text);
}

std::vector<WeatherInterval> intervals_of(WeatherTable& table, const std::optional<PlaceOnEarth>& place,
                                          const WeatherText& text) {
  const double usual_pressure_hpa = standard_pressure_hpa(place ? place->height_m : 0.0);
  IrradianceFiller filler(place, text);
  std::vector<WeatherInterval> intervals;
  for (const WeatherRow& row : table.rows) {
    if (!tells_irradiance(row)) continue;
    WeatherInterval interval;
    interval.middle_utc = std::chrono::sys_time<std::chrono::milliseconds>(row.stamp.time_since_epoch() -
                                                                           table.clock_ahead_of_utc + table.middle_after_stamp);
    interval.duration = table.step;
    interval.global_w_m2 = row.global_w_m2.value_or(0.0);
    interval.direct_normal_w_m2 = row.direct_normal_w_m2.value_or(0.0);
    interval.diffuse_w_m2 = row.diffuse_w_m2.value_or(0.0);
    filler.fill(row, interval);
    set_illuminance(row, interval);
    set_air(row, interval, usual_pressure_hpa);
    intervals.push_back(interval);
  }
  filler.tell(table.remarks, table.rows.size());
  tell_usual_air(table);
  return intervals;
}

}  // namespace farlod
