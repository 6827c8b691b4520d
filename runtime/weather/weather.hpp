// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sun/sun_positions.hpp"
#include "weather/period.hpp"

namespace farlod {

/// What fell in an interval of time.
struct WeatherInterval {
  std::chrono::sys_time<std::chrono::milliseconds> middle_utc;
  std::chrono::milliseconds duration{};
  /// Means of the interval. Global and diffuse are those of a level plane, direct is that of a plane that faces the sun.
  double global_w_m2 = 0.0, direct_normal_w_m2 = 0.0, diffuse_w_m2 = 0.0;
  std::optional<double> direct_normal_lux = {}, diffuse_lux = {};  ///< where the file has both
  /// The usual values where the file has none: 15 °C, the standard atmosphere's pressure at the height of the place, and the dew
  /// point of air of 60 % relative humidity.
  double temperature_c = 15.0, pressure_hpa = 1013.25, dew_point_c = 7.3;

  bool operator==(const WeatherInterval&) const = default;
};

/// Whether a month stands for all months of its name.
enum class WeatherYears : std::uint8_t {
  measured,  ///< each interval was in its own year
  typical    ///< one year of months from different years: an interval stands for its month, day and hour of any year
};

/// The weather of some time at a place.
struct Weather {
  std::string source;                 ///< for people, such as "EPW of Rotterdam, NLD (06344), delft.epw"
  std::optional<PlaceOnEarth> place;  ///< as the file says it, or as it was asked for
  /// By time, without overlap. Those of typical years are in the order of months, and each has the year that it was taken from.
  std::vector<WeatherInterval> intervals;
  std::vector<std::string> remarks;  ///< what was missing, filled, left out or doubtful: told to the user, a sentence each
  WeatherYears years = WeatherYears::measured;
  /// The clock of periods and of months: that of the file, or, where its times are UTC, that of whole hours which is nearest to
  /// local mean time.
  std::chrono::milliseconds clock_ahead_of_utc{};
};

/// Reads a file of weather: EPW, the TMY of PVGIS as CSV, TMY3 of NREL, or a table whose first row names time and global, direct
/// and diffuse irradiance. Its content says which.
///   (1) An interval is the one that the format means: in EPW and TMY3 the hour that ends at the time of the row; in files of
///       PVGIS the hour around the instant of the row, with the irradiance time offset; in tables the one that begins at `time`,
///       ends at `end` or has `middle` in its middle, and lasts until the next row.
///   (2) Rows without irradiance (empty, or codes such as −999 and 9999) are left out, and times without rows stay empty: both
///       are remarks.
///   (3) An irradiance that two others tell is computed; global that stands alone is split after Erbs et al. 1982: remarks.
///   (4) Remarks, too, tell a place that is more than 2° from the city, less than 1 % of the irradiance at night, and global
///       irradiance that direct and diffuse do not make up.
///   (5) Refused is what cannot be: more irradiance at night, direct of more than 1,400 W/m², rows that overlap or were cut off.
/// `city`: the place that the weather is wanted for, where it is known; it stands for that of a file that names none.
/// Throws InputError: the file, the line, what is wrong, and what to do.
[[nodiscard]] Weather read_weather(const std::filesystem::path& path, const std::optional<PlaceOnEarth>& city);

/// The month of an interval, on the clock of the weather.
[[nodiscard]] std::chrono::month month_of(const Weather& weather, const WeatherInterval& interval);

/// What falls within a period. Intervals that a border of the period cuts count with the part that lies in it. What the weather
/// lacks of the period is a remark; throws InputError where it has nothing of it.
[[nodiscard]] Weather within(const Weather& weather, const Period& period);

/// The weather of a period without clouds, in steps, the last of which may be shorter; what it is in a step is what it is in the
/// middle of it. After Ineichen and Perez 2002, which take what is in the air as one number: the Linke turbidity, 2 in
/// mountains, 3 in a clear country, 4 to 5 in cities and in summer.
/// Throws InvalidArgument where the period names no year, the step is less than a second, or the turbidity is not from 1 to 12.
[[nodiscard]] Weather clear_sky_weather(const PlaceOnEarth& place, const Period& period, std::chrono::milliseconds step,
                                        double linke_turbidity);

}  // namespace farlod
