// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/shadow_patches.hpp"

#include <cmath>

#include "base/expects.hpp"

namespace farlod {
namespace {

struct ShadowBand {
  double elevation_deg;
  std::size_t patches;
  double first_azimuth_deg;
};

constexpr std::array<ShadowBand, 8> shadow_bands{{{6.0, 31, 0.0},
                                                  {18.0, 30, 4.0},
                                                  {30.0, 28, 2.0},
                                                  {42.0, 24, 5.0},
                                                  {54.0, 19, 8.0},
                                                  {66.0, 13, 0.0},
                                                  {78.0, 7, 10.0},
                                                  {90.0, 1, 0.0}}};

std::array<ShadowPatch, shadow_patch_count> make_shadow_patches() {
  std::array<ShadowPatch, shadow_patch_count> patches;
  std::size_t next = 0;
  for (const ShadowBand& band : shadow_bands)
    for (std::size_t n = 0; n < band.patches; ++n) {
      const double turn = static_cast<double>(n) / static_cast<double>(band.patches);
      patches[next++] = {Angle::degrees(std::fmod(360.0 * turn + band.first_azimuth_deg, 360.0)),
                         Angle::degrees(band.elevation_deg)};
    }
  FARLOD_EXPECTS(next == patches.size());
  return patches;
}

}  // namespace

const std::array<ShadowPatch, shadow_patch_count>& shadow_patches() {
  static const std::array<ShadowPatch, shadow_patch_count> patches = make_shadow_patches();
  return patches;
}

}  // namespace farlod
