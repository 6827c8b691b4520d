// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "farlod/angle.hpp"
#include "sun/sun_positions.hpp"

namespace farlod {

/// What comes from the sun without an atmosphere, on a plane that faces it: 1,361 W/m² (Kopp and Lean 2011) at a distance of 1
/// au, divided by the square of the distance, which is that of the Astronomical Almanac's formula of low precision (.02 %).
[[nodiscard]] double extraterrestrial_w_m2(std::chrono::sys_time<std::chrono::milliseconds> time_utc);

/// The mass of air that the sun's rays go through, in terms of that overhead: Kasten and Young 1989. Of an elevation below the
/// horizon, it is that of the horizon.
[[nodiscard]] double relative_air_mass(Angle elevation);

/// The pressure of the standard atmosphere at a height above the sea.
[[nodiscard]] double standard_pressure_hpa(double height_m);

/// The dew point of air (Magnus's formula, with the numbers of Alduchov and Eskridge 1996). `humidity_percent` is larger than 0.
[[nodiscard]] double dew_point_c(double temperature_c, double humidity_percent);

/// The mean over an interval of the sine of the sun's elevation, 0 below the horizon: what a level plane gets of each W/m² of
/// direct irradiance.
[[nodiscard]] double mean_sine_of_sun(const PlaceOnEarth& place, std::chrono::sys_time<std::chrono::milliseconds> middle_utc,
                                      std::chrono::milliseconds duration);

/// The share of global irradiance that is diffuse, by the share of extraterrestrial irradiance that reaches the ground, the
/// clearness index: Erbs, Klein and Duffie 1982.
[[nodiscard]] double diffuse_share(double clearness);

/// Irradiances of a clear sky.
struct ClearSky {
  double global_w_m2 = 0.0, direct_normal_w_m2 = 0.0, diffuse_w_m2 = 0.0;
};

/// What the model of a clear sky knows of the air.
struct ClearAir {
  double air_mass = 1.0;  ///< relative, times pressure over that at the sea
  double linke_turbidity = 3.0;
  double height_m = 0.0;  ///< above the sea
};

/// The clear sky of Ineichen and Perez 2002, with the formula for global irradiance as Perez et al. 2002 print it, without the
/// factor exp(.01 air_mass^1.8) that some add. Nothing where the sun is below the horizon.
[[nodiscard]] ClearSky clear_sky(Angle elevation, const ClearAir& air, double extraterrestrial_w_m2);

}  // namespace farlod
