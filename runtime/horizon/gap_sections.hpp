// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/facets_in_sight.hpp"
#include "horizon/gap_kernels.hpp"
#include "horizon/overhang_facets.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// The gaps below overhangs in which receivers may see sky: at each azimuth between two horizons, but not between two others.
struct Gaps {
  const PacketHorizon &from, &to;
  const PacketHorizon &hidden_from, &hidden_to;
  std::span<const PacketHorizon::Row> sky;  ///< what a receiver would see in each; there is no gap where that is nothing
  std::uint32_t receivers;                  ///< a bit for each that is asked for
};

/// Sky that a receiver sees in a gap at one azimuth.
struct OpenGap {
  std::uint32_t azimuth = 0, lane = 0;
  float from = 0.0F, to = 0.0F;                ///< all that is open is between these slopes
  float hidden_from = 0.0F, hidden_to = 0.0F;  ///< but for these
  float sky = 0.0F;                            ///< as a share of that of the azimuth
  bool is_split = false;                       ///< more is hidden between the slopes
};

/// The sky in gaps, from the sections of all facets at each azimuth: exact there. docs/concepts.md, "What is grounded, and what
/// overhangs".
class GapSections {
 public:
  /// The sampling must outlive it.
  explicit GapSections(const AzimuthSampling& azimuths);

  /// Begins a group of packets, which have these horizons.
  void begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> grounded);
  /// What these facets leave open of the gaps of a packet of the group, which begin no lower than those horizons. The facets are
  /// the same for all of the group.
  [[nodiscard]] std::span<const OpenGap> find_open(const OverhangFacets& facets, const Gaps& gaps, SkyWeight weight,
                                                   const ReceiverPacket& receivers);
  /// The same for gaps that begin anywhere.
  [[nodiscard]] std::span<const OpenGap> find_any_open(const OverhangFacets& facets, const Gaps& gaps, SkyWeight weight,
                                                       const ReceiverPacket& receivers);

 private:
  void find_open_among(const OverhangFacets& sorted, const Gaps& gaps, SkyWeight weight, const ReceiverPacket& receivers);
  void collect(const Gaps& gaps);
  /// Narrows gaps to what facets leave open, and adds what is left to `left_` and `left_split_`.
  void narrow(std::span<const OpenGap> gaps, const FacetsInBoxes& facets, SkyWeight weight, const ReceiverPacket& receivers);
  void put(std::span<const OpenGap> gaps, const ReceiverPacket& receivers, GapBlock& block) const;

  const AzimuthSampling& azimuths_;
  FacetsInSight in_sight_, of_packet_;
  std::vector<OpenGap> open_, split_;
  // Working memory, kept from packet to packet
  std::vector<OpenGap> left_, left_split_;
  std::vector<std::uint16_t> found_;
  std::vector<PacketHorizon::Row> room_;
};

}  // namespace farlod
