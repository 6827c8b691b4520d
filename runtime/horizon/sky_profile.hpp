// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"

namespace farlod {

/// A sky view factor, and the bounds that are certain for the same azimuths.
struct SvfInterval {
  float low = 0.0F, estimate = 0.0F, high = 0.0F;

  [[nodiscard]] float width() const { return high - low; }
};

/// The interval with its estimate moved towards the middle, until it is no farther than `error` from either end, as long as
/// that is possible.
[[nodiscard]] inline SvfInterval within_error(const SvfInterval& svf, float error) {
  const float most = std::max(svf.low, svf.high - error), least = std::min(svf.high, svf.low + error);
  return {svf.low, std::clamp(svf.estimate, std::min(most, least), std::max(most, least)), svf.high};
}

/// What the receivers of a packet see at each azimuth of a sampling, by slopes (tangents of elevations), from below: nothing; sky
/// in a gap below an overhang, of which they see a share; nothing; and from `sky_from` upwards, sky. Rows [azimuth][receiver].
struct SkyProfile {
  using Rows = std::vector<PacketHorizon::Row>;

  explicit SkyProfile(const AzimuthSampling& azimuths) : sky_from(azimuths.size()) {}

  Rows sky_from;                     ///< infinite where there is no sky above
  Rows gap_from, gap_to, gap_share;  ///< empty if there is no gap; the share is that of the gap's sky, from 0 to 1
  /// The sky above `sky_from`, F(φ) of docs/concepts.md, "Above a horizon", with the jumps of the horizon where they are: their
  /// mean over the azimuths is the view factor of that sky, by the cosine and by solid angle. Empty where `sky_from` is all that
  /// is known.
  Rows sky, solid_sky;
  /// `sky`, with smaller jumps where they are, too: what an azimuth has is worth more where the sun is. Their mean is not the
  /// view factor that is answered, which lets these be.
  Rows light_sky;
};

/// What a profile is to hold beside the sky by the cosine.
struct ProfileRows {
  bool solid_sky = false, light_sky = false;
};

}  // namespace farlod
