// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// Where the sun is for some time. What lies at the horizon or below it is no sunshine.
struct SunPosition {
  Angle azimuth;  ///< clockwise from true north
  Angle elevation;
  double hours = 0.0;  ///< that this position stands for
};

/// How the light of the sky is spread over it.
enum class SkyModel : std::uint8_t {
  perez,  ///< as R. Perez, R. Seals and J. Michalsky have it (Solar Energy 50, 1993): brighter around the sun and at the horizon
  isotropic  ///< the same radiance everywhere
};
inline constexpr std::array<Word<SkyModel>, 2> sky_model_words{{{"perez", SkyModel::perez}, {"isotropic", SkyModel::isotropic}}};

/// A part of a period, an hour for instance, of which irradiances are known as means.
struct LightInterval {
  /// Where the sun is while it is up, in steps; none at night. The energy of the interval is shared out by their hours.
  std::vector<SunPosition> sun;
  double hours = 0.0;
  double direct_normal_w_m2 = 0.0;        ///< on a plane that faces the sun
  double diffuse_w_m2 = 0.0;              ///< of the sky, on a level plane
  double extraterrestrial_w_m2 = 1361.0;  ///< outside of the atmosphere, on a plane that faces the sun
  unsigned month = 1;                     ///< 1 to 12
  std::chrono::local_seconds begin{};     ///< on the clock of the period
  /// The same two as light to the eye, where it is known.
  std::optional<double> direct_normal_lux = {}, diffuse_lux = {};
};

/// Whether it has a sun above the horizon.
[[nodiscard]] inline bool has_sun(const LightInterval& interval) {
  return std::any_of(interval.sun.begin(), interval.sun.end(), [](const SunPosition& s) { return s.elevation.radians() > 0.0; });
}

/// The light of a period, and what reflects it.
struct Light {
  std::vector<LightInterval> intervals;
  SkyModel sky_model = SkyModel::perez;
  /// The shares of light that the ground and façades reflect, 0 to 1.
  double ground_albedo = 0.2, facade_albedo = 0.2;
  bool by_month = false;  ///< irradiation has a column for each month, too
  bool by_step = false;   ///< shade has a column for each interval with a sun above the horizon, too
};

}  // namespace farlod
