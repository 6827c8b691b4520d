// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "radiation/perez_sky.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// x = x₁ + x₂ Z + Δ (x₃ + x₄ Z), but for c and d of the first bin.
using Coefficients = std::array<double, 4>;
struct ClearnessBin {
  double clearness_to;  ///< it ends there
  Coefficients a, b, c, d, e;
};

/// Table 1 of the paper.
constexpr std::array<ClearnessBin, 8> bins{{
    {1.065,
     {1.3525, -0.2576, -0.2690, -1.4366},
     {-0.7670, 0.0007, 1.2734, -0.1233},
     {2.8000, 0.6004, 1.2375, 1.0000},
     {1.8734, 0.6297, 0.9738, 0.2809},
     {0.0356, -0.1246, -0.5718, 0.9938}},
    {1.230,
     {-1.2219, -0.7730, 1.4148, 1.1016},
     {-0.2054, 0.0367, -3.9128, 0.9156},
     {6.9750, 0.1774, 6.4477, -0.1239},
     {-1.5798, -0.5081, -1.7812, 0.1080},
     {0.2624, 0.0672, -0.2190, -0.4285}},
    {1.500,
     {-1.1000, -0.2515, 0.8952, 0.0156},
     {0.2782, -0.1812, -4.5000, 1.1766},
     {24.7219, -13.0812, -37.7000, 34.8438},
     {-5.0000, 1.5218, 3.9229, -2.6204},
     {-0.0156, 0.1597, 0.4199, -0.5562}},
    {1.950,
     {-0.5484, -0.6654, -0.2672, 0.7117},
     {0.7234, -0.6219, -5.6812, 2.6297},
     {33.3389, -18.3000, -62.2500, 52.0781},
     {-3.5000, 0.0016, 1.1477, 0.1062},
     {0.4659, -0.3296, -0.0876, -0.0329}},
    {2.800,
     {-0.6000, -0.3566, -2.5000, 2.3250},
     {0.2937, 0.0496, -5.6812, 1.8415},
     {21.0000, -4.7656, -21.5906, 7.2492},
     {-3.5000, -0.1554, 1.4062, 0.3988},
     {0.0032, 0.0766, -0.0656, -0.1294}},
    {4.500,
     {-1.0156, -0.3670, 1.0078, 1.4051},
     {0.2875, -0.5328, -3.8500, 3.3750},
     {14.0000, -0.9999, -7.1406, 7.5469},
     {-3.4000, -0.1078, -1.0750, 1.5702},
     {-0.0672, 0.4016, 0.3017, -0.4844}},
    {6.200,
     {-1.0000, 0.0211, 0.5025, -0.5119},
     {-0.3000, 0.1922, 0.7023, -1.6317},
     {19.0000, -5.0000, 1.2438, -1.9094},
     {-4.0000, 0.0250, 0.3844, 0.2656},
     {1.0468, -0.3788, -2.4517, 1.4656}},
    {HUGE_VAL,
     {-1.0500, 0.0289, 0.4260, 0.3590},
     {-0.3250, 0.1156, 0.7781, 0.0025},
     {31.0625, -14.5000, -46.1148, 55.3750},
     {-7.2312, 0.4050, 13.3500, 0.6234},
     {1.5000, -0.6426, 1.8564, 0.5636}},
}};

/// Below it the coefficients of the bins between are not meant: the horizon would be infinitely bright.
constexpr double least_brightness_between = 0.2;
/// The skies of the paper have no others; gendaylit of Radiance has the same limits.
constexpr double least_brightness = 0.01, most_brightness = 0.6;
constexpr std::size_t first_between = 1, last_between = 4;

/// Lower than .6°, where some skies would be infinitely bright, the gradation is that of .6°, as in perezlum.cal of Radiance.
constexpr double least_cosine = 0.01;

double kasten_air_mass(Angle zenith) { return 1.0 / (cos(zenith) + 0.15 * std::pow(93.885 - zenith.degrees(), -1.253)); }

}  // namespace

SkyState sky_state(Angle sun_zenith, const SkyIrradiances& irradiances) {
  FARLOD_EXPECTS(irradiances.diffuse_w_m2 > 0.0 && irradiances.extraterrestrial_w_m2 > 0.0);
  constexpr double kappa = 1.041;
  const double z = sun_zenith.radians(), beside = kappa * z * z * z;
  const double clearness =
      ((irradiances.diffuse_w_m2 + irradiances.direct_normal_w_m2) / irradiances.diffuse_w_m2 + beside) / (1.0 + beside);
  const double brightness = kasten_air_mass(sun_zenith) * irradiances.diffuse_w_m2 / irradiances.extraterrestrial_w_m2;
  return {sun_zenith, clearness, brightness};
}

PerezSky::PerezSky(const SkyState& state) {
  std::size_t n = 0;
  while (state.clearness >= bins[n].clearness_to) ++n;
  const ClearnessBin& bin = bins[n];
  const bool is_between = n >= first_between && n <= last_between;
  const double z = state.sun_zenith.radians();
  const double delta = std::clamp(state.brightness, is_between ? least_brightness_between : least_brightness, most_brightness);
  const auto at = [&](const Coefficients& x) { return x[0] + x[1] * z + delta * (x[2] + x[3] * z); };
  a_ = at(bin.a);
  b_ = at(bin.b);
  c_ = n > 0 ? at(bin.c) : std::exp(std::pow(delta * (bin.c[0] + bin.c[1] * z), bin.c[2])) - bin.c[3];
  d_ = n > 0 ? at(bin.d) : -std::exp(delta * (bin.d[0] + bin.d[1] * z)) + bin.d[2] + delta * bin.d[3];
  e_ = at(bin.e);
}

double PerezSky::gradation(double cos_zenith_distance) const {
  return 1.0 + a_ * std::exp(b_ / std::max(cos_zenith_distance, least_cosine));
}

double PerezSky::indicatrix(const SunDistance& sun_distance) const {
  return 1.0 + c_ * std::exp(d_ * sun_distance.angle.radians()) + e_ * sun_distance.cosine * sun_distance.cosine;
}

double overcast_radiance(Angle zenith_distance) { return (1.0 + 2.0 * cos(zenith_distance)) / 3.0; }

}  // namespace farlod
