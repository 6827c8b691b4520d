// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/weather.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "farlod/error.hpp"
#include "weather/solar_radiation.hpp"
#include "weather/weather_table.hpp"

namespace farlod {
namespace {

using std::chrono::milliseconds;

/// A kind of file.
struct WeatherFormat {
  bool (*is)(const WeatherText&);
  WeatherTable (*read)(const WeatherText&);
};

/// In the order in which they are tried: any text may be a table of names.
constexpr WeatherFormat weather_formats[] = {{is_epw, read_epw},
                                             {is_pvgis_tmy, read_pvgis_tmy},
                                             {is_tmy3, read_tmy3},
                                             {[](const WeatherText&) { return true; }, read_named_columns}};

WeatherTable table_in(const WeatherText& text) {
  const auto format = std::ranges::find_if(weather_formats, [&](const WeatherFormat& kind) { return kind.is(text); });
  WeatherTable table = format->read(text);
  if (table.rows.empty()) text.refuse_file("the file has no rows below its header: it was cut off; get it again");
  return table;
}

/// The clock of whole hours that is nearest to local mean time.
milliseconds clock_by_longitude(const PlaceOnEarth& place) {
  constexpr double degrees_an_hour = 15.0;
  return std::chrono::hours(std::lround(place.longitude.degrees() / degrees_an_hour));
}

/// People mean the clock of the place, where files are in UTC.
void set_clock(Weather& weather, milliseconds of_file) {
  weather.clock_ahead_of_utc = of_file;
  if (of_file != milliseconds(0) || !weather.place) return;
  weather.clock_ahead_of_utc = clock_by_longitude(*weather.place);
  if (weather.clock_ahead_of_utc != milliseconds(0))
    weather.remarks.push_back(
        fmt::format("Times of the file are UTC; days, months and times of a period are those of {}, by the "
                    "longitude.",
                    clock_text(weather.clock_ahead_of_utc)));
}

/// Sets the irradiances of a clear sky in intervals of which the times are set.
void fill_with_clear_sky(std::vector<WeatherInterval>& intervals, const PlaceOnEarth& place, double linke_turbidity) {
  const double pressure_hpa = standard_pressure_hpa(place.height_m);
  std::vector<std::chrono::sys_time<milliseconds>> times;
  for (const WeatherInterval& interval : intervals) times.push_back(interval.middle_utc);
  const std::vector<SunDirection> suns = sun_directions(place, times, {pressure_hpa, WeatherInterval().temperature_c});
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const double air_mass = relative_air_mass(suns[n].elevation) * pressure_hpa / standard_pressure_hpa(0.0);
    const ClearSky sky =
        clear_sky(suns[n].elevation, {air_mass, linke_turbidity, place.height_m}, extraterrestrial_w_m2(times[n]));
    intervals[n].pressure_hpa = pressure_hpa;
    intervals[n].global_w_m2 = sky.global_w_m2;
    intervals[n].direct_normal_w_m2 = sky.direct_normal_w_m2;
    intervals[n].diffuse_w_m2 = sky.diffuse_w_m2;
  }
}

}  // namespace

Weather read_weather(const std::filesystem::path& path, const std::optional<PlaceOnEarth>& city) {
  const WeatherText text(path);
  WeatherTable table = table_in(text);
  check_times(table, text);
  clean_values(table, text);
  if (city) check_place(table, *city);
  Weather weather;
  weather.place = table.place ? table.place : city;
  weather.intervals = intervals_of(table, weather.place, text);
  if (weather.place)
    check_with_sun(table, weather.intervals, *weather.place, text);
  else
    table.remarks.push_back("The place of " + text.name() + " is not known: its times were not compared with the sun.");
  weather.source = std::move(table.source);
  weather.remarks = std::move(table.remarks);
  weather.years = table.years;
  set_clock(weather, table.clock_ahead_of_utc);
  return weather;
}

Weather clear_sky_weather(const PlaceOnEarth& place, const Period& period, milliseconds step, double linke_turbidity) {
  constexpr double least_turbidity = 1.0, largest_turbidity = 12.0;
  if (period.of_any_year)
    throw InvalidArgument("\"" + period.text + "\" has no year, which the clear sky needs; write it like 2026-06-21");
  if (step < std::chrono::seconds(1)) throw InvalidArgument("the step of the clear sky is less than a second; give minutes");
  if (!(least_turbidity <= linke_turbidity && linke_turbidity <= largest_turbidity))
    throw InvalidArgument(
        fmt::format("a Linke turbidity of {} cannot be; give 1 (the cleanest air) to 12, usually 3", linke_turbidity));
  Weather weather;
  weather.source = fmt::format("the clear sky of Ineichen and Perez 2002, Linke turbidity {:.3g}", linke_turbidity);
  weather.place = place;
  weather.clock_ahead_of_utc = period.clock_ahead_of_utc ? *period.clock_ahead_of_utc : clock_by_longitude(place);
  for (ClockTime begin = period.begin; begin < period.end; begin += step) {
    WeatherInterval interval;
    interval.duration = std::min(step, period.end - begin);
    const ClockTime middle = begin + interval.duration / 2;
    interval.middle_utc = std::chrono::sys_time<milliseconds>(middle.time_since_epoch() - weather.clock_ahead_of_utc);
    weather.intervals.push_back(interval);
  }
  fill_with_clear_sky(weather.intervals, place, linke_turbidity);
  return weather;
}

}  // namespace farlod
