// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"

/// What the light of a distribution over the sky (radiation/light_table.hpp) sums up to above horizons. docs/concepts.md, "The
/// light of a period".
namespace farlod {

/// Two layers of light side by side: what comes along an azimuth, and upwards.
struct alignas(16) LightPair {
  std::array<float, 2> along{}, up{};
};

/// Pairs of one table: what is even, direct and diffuse, twelve months, and illuminance.
inline constexpr std::size_t most_light_pairs = 9;
/// Slopes t, 0 or more, lie among knots that are even in t / (1 + t): .22° apart at the horizon and at the zenith, .45° at 45°.
inline constexpr std::uint32_t last_light_knot = 256;
/// Slopes from here on are as good as the zenith: what is above them counts for nothing.
inline constexpr float no_light_above = 1e5F;

/// The light above each knot.
struct LightScene {
  const LightPair* even;     ///< even[knot]: the uniform sky, of which nothing is read here, and another that is alike all round
  const LightPair* pairs;    ///< pairs[azimuth][knot][pair]
  std::uint32_t pair_count;  ///< of one knot: fewer than most_light_pairs, since the even ones are apart
  bool wants_even;           ///< whether that which is alike all round is summed up
  AzimuthView azimuths;
};

/// Where a packet sees it.
struct LitPacket {
  const ReceiverPacket* receivers;
  bool all_look_up;  ///< all normals point straight up
  /// Rows of a SkyProfile: sky_from; gap_from, gap_to and gap_share, or null; light_sky, or null.
  const float *sky_from, *gap_from, *gap_to, *gap_share, *sky;
  /// Takes sums[layer][receiver] of 2 + 2 pair_count layers: the uniform sky, the other one that is alike all round, and those of
  /// the pairs.
  float* sums;
};

struct LightKernels {
  /// Sums up what each packet sees. Where the horizon jumps between two azimuths, `sky` knows at which place: so much of an
  /// azimuth's part of the turn has the horizon of its neighbor.
  void (*sum_light)(const LightScene& scene, std::span<const LitPacket> packets);
};

}  // namespace farlod
