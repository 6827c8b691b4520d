// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/light.hpp"
#include "farlod/weather.hpp"

namespace farlod {

/// What refracts light near the ground.
struct Atmosphere {
  double pressure_hpa = 1010.0, temperature_c = 10.0;
};

/// Where the middle of the sun is seen.
struct SunDirection {
  Angle azimuth;  ///< clockwise from true north
  Angle elevation;
};

/// The sun's direction at a time (UTC, from 1960 on), with aberration, parallax and refraction, by ERFA (the SOFA functions of
/// the IAU): for centuries better than .001°, were it not for the refraction, which is Sæmundsson's formula (as in NREL's SPA)
/// and depends on the weather.
[[nodiscard]] SunDirection sun_direction(const PlaceOnEarth& place, std::chrono::sys_time<std::chrono::milliseconds> time_utc,
                                         const Atmosphere& atmosphere = {});

/// The same of many times, in any order: where many follow each other in a day, in a thirtieth of the time, and to .0002° the
/// same.
[[nodiscard]] std::vector<SunDirection> sun_directions(
    const PlaceOnEarth& place, std::span<const std::chrono::sys_time<std::chrono::milliseconds>> times_utc,
    const Atmosphere& atmosphere = {});

/// The directions of the sun above the horizon, in the middle of steps of so many minutes, from the midnight before `first` on
/// for some days. Midnight is that of local mean time: hours of sunshine depend on no time zone.
[[nodiscard]] std::vector<SunPosition> sun_positions(const PlaceOnEarth& place, std::chrono::sys_days first, std::size_t days,
                                                     std::chrono::minutes step);

/// Where the sun is each minute of a day of local mean time, from midnight to midnight, above the horizon or below it.
[[nodiscard]] std::vector<SunDirection> sun_course(const PlaceOnEarth& place, std::chrono::sys_days day);

/// What local mean time is ahead of UTC.
[[nodiscard]] std::chrono::milliseconds local_mean_time_ahead(Angle longitude);

}  // namespace farlod
