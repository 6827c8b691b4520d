// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "farlod/angle.hpp"

namespace farlod {

/// What Perez' sky depends on.
struct SkyState {
  Angle sun_zenith;         ///< at most 90°
  double clearness = 1.0;   ///< ε: 1 below clouds, more than 6.2 where the sky is clear
  double brightness = 0.1;  ///< Δ
};

/// The state of a sky of which irradiances are known: diffuse on a level plane, above 0, the others on a plane that faces the
/// sun. R. Perez et al., Solar Energy 44 (1990) 271, equations 1 and 2; the air mass is that of F. Kasten (1965), as there.
struct SkyIrradiances {
  double diffuse_w_m2 = 0.0, direct_normal_w_m2 = 0.0, extraterrestrial_w_m2 = 0.0;
};
[[nodiscard]] SkyState sky_state(Angle sun_zenith, const SkyIrradiances& irradiances);

/// From the sun to a place of the sky. Implicit, so that an angle may stand for it.
struct SunDistance {
  SunDistance(Angle a = {}) : angle(a), cosine(cos(a)) {}
  Angle angle;
  double cosine;
};

/// The sky of R. Perez, R. Seals and J. Michalsky, All-weather model for sky luminance distribution, Solar Energy 50 (1993) 235,
/// with the erratum in 51 (1993) 423. Radiances are relative: somebody must scale them.
///   (1) l(ζ, γ) = (1 + a exp(b / cos ζ)) (1 + c exp(d γ) + e cos² γ), and no less than 0
///   (2) cos ζ counts as no less than .01, as Radiance has it
///   (3) Δ counts as .01 to .6, and as no less than .2 where 1.065 ≤ ε < 2.8, as Radiance has it
class PerezSky {
 public:
  explicit PerezSky(const SkyState& state);

  /// ζ is the zenith distance of a place of the sky, at most 90°, γ its distance to the sun.
  [[nodiscard]] double radiance(Angle zenith_distance, Angle sun_distance) const {
    const double l = gradation(cos(zenith_distance)) * indicatrix(sun_distance);
    return l > 0.0 ? l : 0.0;
  }
  /// The two factors of (1).
  [[nodiscard]] double gradation(double cos_zenith_distance) const;
  [[nodiscard]] double indicatrix(const SunDistance& sun_distance) const;

 private:
  double a_, b_, c_, d_, e_;
};

/// The CIE's overcast sky, relative to its zenith.
[[nodiscard]] double overcast_radiance(Angle zenith_distance);

}  // namespace farlod
