// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// Places the jumps of horizons where they are. A sum over azimuths takes a jump between two of them to be in the middle. But the
/// edge that the higher horizon belongs to is known, and so is where it ends, and which border is highest from there on.
/// docs/concepts.md, "Above a horizon".
class HorizonJumps {
 public:
  /// Fewer azimuths are too far apart to take the sine of an angle between them for the angle.
  static constexpr std::size_t least_azimuths = 32;
  /// Jumps of less sky than `jump` stay where they are: there are many, and together they are worth little. What comes into sight
  /// beside the end of a border is looked for where more than `beyond` would be left to the lower horizon.
  struct Least {
    float jump, beyond;
  };
  /// Light is worth more than sky where the sun is.
  static constexpr Least least_of_sky{0.1F, 0.2F}, least_of_light{0.01F, 0.05F};
  /// With fewer azimuths, more of them are cheaper than to look for it.
  static constexpr std::size_t least_azimuths_to_look = 256;
  /// What a horizon must know of its edges.
  [[nodiscard]] static PacketHorizon::Edges edges_for(const AzimuthSampling& azimuths) {
    return azimuths.size() < least_azimuths_to_look ? PacketHorizon::Edges::numbered : PacketHorizon::Edges::tracked;
  }

  /// Both must outlive it. The sampling must be even, and `ends` have the numbers of the borders.
  HorizonJumps(const AzimuthSampling& azimuths, const BorderEnds& ends)
      : azimuths_(azimuths), ends_(ends), sky_(azimuths.size()), jumps_(azimuths.size()) {}

  /// The sky above a horizon, in [0, 1], and how much of it horizon.sky_above lacks, or has too much.
  struct SkyAbove {
    PacketHorizon::Lanes sky, correction;
  };
  /// Take the sky of each azimuth by itself, which the corrections of its jumps are a part of; or nothing, where there are no
  /// rows.
  struct OfAzimuths {
    std::span<PacketHorizon::Row> sky = {}, for_light = {};  ///< with jumps down to least_of_sky, and to least_of_light
  };
  /// The horizon must know of its edges what edges_for() says. No correction with fewer than `least_azimuths`. Nothing is looked
  /// for beyond the borders of receivers `in_recess`, since their own borders were drawn for others.
  [[nodiscard]] SkyAbove sky_above(const PacketHorizon& horizon, SkyWeight weight, const ReceiverPacket& receivers,
                                   std::uint32_t in_recess, const OfAzimuths& of_azimuths);

 private:
  /// What one jump of one receiver adds to the sum over the azimuths.
  struct Correction {
    float sky = 0.0F, light = 0.0F;
    std::size_t higher = 0, lower = 0;  ///< the azimuths of both horizons
    float jump = 0.0F;                  ///< the sky between both
    /// One that reaches far hides sky of the other azimuth; one that does not leaves sky of its own.
    [[nodiscard]] std::size_t azimuth_of(float added) const { return added > 0.0F ? higher : lower; }
  };
  struct Seen {
    const PacketHorizon& horizon;
    SkyWeight weight;
    const ReceiverPacket& receivers;
    Least least;
    std::uint32_t in_recess;
  };
  [[nodiscard]] Correction correction_of(std::size_t azimuth, std::size_t lane, const Seen& seen) const;
  [[nodiscard]] std::size_t after(std::size_t azimuth) const { return azimuth + 1 < azimuths_.size() ? azimuth + 1 : 0; }

  const AzimuthSampling& azimuths_;
  const BorderEnds& ends_;
  // Working memory, kept from packet to packet
  std::vector<PacketHorizon::Row> sky_;  ///< of each azimuth
  std::vector<SkyJump> jumps_;
};

}  // namespace farlod
