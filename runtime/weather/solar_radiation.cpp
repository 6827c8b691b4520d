// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "weather/solar_radiation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace farlod {

using SysMilliseconds = std::chrono::sys_time<std::chrono::milliseconds>;

double extraterrestrial_w_m2(SysMilliseconds time_utc) {
  constexpr double solar_constant_w_m2 = 1361.0;
  const auto epoch = std::chrono::sys_days(std::chrono::year(2000) / 1 / 1) + std::chrono::hours(12);
  const double days = std::chrono::duration<double, std::chrono::days::period>(time_utc - epoch).count();
  const double anomaly = Angle::degrees(357.528 + 0.9856003 * days).radians();
  const double distance_au = 1.00014 - 0.01671 * std::cos(anomaly) - 0.00014 * std::cos(2.0 * anomaly);
  return solar_constant_w_m2 / (distance_au * distance_au);
}

double relative_air_mass(Angle elevation) {
  const double above_deg = std::max(elevation.degrees(), 0.0);
  return 1.0 / (std::sin(Angle::degrees(above_deg).radians()) + 0.50572 * std::pow(above_deg + 6.07995, -1.6364));
}

double standard_pressure_hpa(double height_m) {
  constexpr double sea_hpa = 1013.25, lapse_per_m = 2.25577e-5, exponent = 5.25588;
  constexpr double highest_m = 30000.0;  // beyond, the formula would take a root of nothing
  return sea_hpa * std::pow(1.0 - lapse_per_m * std::min(height_m, highest_m), exponent);
}

double dew_point_c(double temperature_c, double humidity_percent) {
  constexpr double a = 17.625, b_c = 243.04;
  const double g = std::log(humidity_percent / 100.0) + a * temperature_c / (b_c + temperature_c);
  return b_c * g / (a - g);
}

double mean_sine_of_sun(const PlaceOnEarth& place, SysMilliseconds middle_utc, std::chrono::milliseconds duration) {
  // An hour at sunrise has light in a part of it: the middles of six parts leave an error below a hundredth of the sine at noon
  constexpr int parts = 6;
  std::array<SysMilliseconds, parts> times;
  for (int n = 0; n < parts; ++n) times[static_cast<std::size_t>(n)] = middle_utc + duration * (2 * n + 1 - parts) / (2 * parts);
  double sum = 0.0;
  for (const SunDirection& sun : sun_directions(place, times)) sum += std::max(0.0, sin(sun.elevation));
  return sum / parts;
}

double diffuse_share(double clearness) {
  const double k = std::max(clearness, 0.0);
  if (k <= 0.22) return 1.0 - 0.09 * k;
  if (k > 0.8) return 0.165;
  return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

ClearSky clear_sky(Angle elevation, const ClearAir& air, double extraterrestrial_w_m2) {
  const double sine = sin(elevation);
  if (sine <= 0.0) return {};
  // The names are those of the paper
  const double fh1 = std::exp(-air.height_m / 8000.0), fh2 = std::exp(-air.height_m / 1250.0);
  const double cg1 = 5.09e-5 * air.height_m + 0.868, cg2 = 3.92e-5 * air.height_m + 0.0387;
  const double b = 0.664 + 0.163 / fh1;
  const double tl = air.linke_turbidity;
  const double global = cg1 * extraterrestrial_w_m2 * sine * std::exp(-cg2 * air.air_mass * (fh1 + fh2 * (tl - 1.0)));
  const double beam = b * extraterrestrial_w_m2 * std::exp(-0.09 * air.air_mass * (tl - 1.0));
  // The least share of diffuse irradiance that is ever met keeps the beam of low suns below the global irradiance
  const double beam_at_most = global * (1.0 - (0.1 - 0.2 * std::exp(-tl)) / (0.1 + 0.882 / fh1)) / sine;
  const double direct = std::clamp(beam, 0.0, std::max(0.0, beam_at_most));
  return {global, direct, global - direct * sine};
}

}  // namespace farlod
