// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "canopy/canopy_sky.hpp"
#include "farlod/canopy.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/sky_profile.hpp"
#include "tests/runtime/canopy/crowns_by_hand.hpp"
#include "tests/runtime/horizon/random_places.hpp"

namespace farlod {

/// A receiver at the origin that looks up, alone.
[[nodiscard]] inline ReceiverPacket receiver_at_origin() {
  ReceiverPacket packet;
  packet.add({});
  return packet;
}

/// The SVF with canopies of a receiver at the origin in the open.
[[nodiscard]] inline double svf_total_at_origin(std::span<const Crown> crowns, const CanopySettings& settings,
                                                std::size_t azimuths) {
  const AzimuthSampling sampling = AzimuthSampling::even(azimuths, {});
  const CanopyShares shares =
      CanopySky(sampling).evaluate(SkyProfile(sampling), receiver_at_origin(), CrownBatches(crowns, settings));
  return static_cast<double>(shares.svf_total(0, 1.0F));
}

/// Crowns of all shapes and kinds of foliage, at most `reach_m` away in x and y; their bottoms begin at −2 m, and a packet at
/// heights from −4 to 15 m has receivers below, in and above some of them.
[[nodiscard]] inline std::vector<Crown> some_crowns(RandomPlaces& random, std::size_t count, double reach_m) {
  std::vector<Crown> crowns;
  for (std::size_t n = 0; n < count; ++n) {
    const Point3f p = random.place(reach_m, -2.0, 6.0);
    Crown crown = crown_at(static_cast<CrownShape>(n % 3), {p.x, p.y}, random.between(0.4, 4.0),
                           {p.z, p.z + random.between(0.5, 9.0)}, static_cast<Foliage>(n / 3 % 3));
    if (crown.shape == CrownShape::prism) crown.turn = static_cast<std::uint16_t>(random.between(0.0, 65535.0));
    crowns.push_back(crown);
  }
  return crowns;
}

/// How the receivers of a packet look.
enum class Looks : std::uint8_t { up, level, anywhere };

[[nodiscard]] inline ReceiverPacket some_receivers(RandomPlaces& random, Looks looks) {
  ReceiverPacket packet;
  const Point3f middle = random.place(10.0, -1.0, 12.0);
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    const Point3f aside = random.place(2.0, -3.0, 3.0);
    const double z = looks == Looks::up ? 1.0 : looks == Looks::level ? 0.0 : static_cast<double>(random.between(-0.9, 1.0));
    packet.add({l, {middle.x + aside.x, middle.y + aside.y, middle.z + aside.z}, random.direction_at(z)});
  }
  return packet;
}

/// Horizons of all slopes, level ones and closed ones, and gaps below some of them.
[[nodiscard]] inline SkyProfile some_profile(RandomPlaces& random, const AzimuthSampling& azimuths, bool has_gaps) {
  SkyProfile profile(azimuths);
  if (has_gaps)
    for (SkyProfile::Rows* rows : {&profile.gap_from, &profile.gap_to, &profile.gap_share}) rows->resize(azimuths.size());
  for (std::size_t k = 0; k < azimuths.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const float kind = random.between(0.0, 1.0);
      profile.sky_from[k][l] = kind < 0.3F    ? 0.0F
                               : kind > 0.97F ? std::numeric_limits<float>::infinity()
                                              : std::tan(random.between(0.0, 1.4));
      if (!has_gaps || kind < 0.5F || kind > 0.97F) continue;
      profile.gap_from[k][l] = profile.sky_from[k][l] * random.between(0.0, 0.5);
      profile.gap_to[k][l] = profile.sky_from[k][l] * random.between(0.5, 0.9);
      profile.gap_share[k][l] = random.between(0.0, 1.0);
    }
  return profile;
}

}  // namespace farlod
