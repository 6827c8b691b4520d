// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "farlod/evaluation.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/facets_in_sight.hpp"
#include "horizon/gap_kernels.hpp"
#include "horizon/overhang_facets.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {

/// The sky below overhangs between two azimuths: as much of it as the facets certainly leave open, and certainly hide.
/// docs/concepts.md, "Bounds of a sky view factor".
class WedgeGaps {
 public:
  using Row = PacketHorizon::Row;
  /// The sampling must outlive it.
  explicit WedgeGaps(const AzimuthSampling& azimuths) : azimuths_(azimuths), in_sight_(azimuths, RaisingAt::wedges) {}

  /// Begins a group of packets, which have these horizons.
  void begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> grounded) {
    in_sight_.begin(packets, grounded);
  }

  /// A receiver's wedge, and slopes in it: between `from` and `to`, only facets hide the sky, and nothing does above `top`. All
  /// is hidden below `lid`, if that is finite; between that and `from`, so much as `below` is open, in radians, but for facets.
  struct Gap {
    std::uint32_t azimuth, lane;  ///< the first one of the wedge
    float from, to, top = 0.0F;
    float lid = std::numeric_limits<float>::infinity(), below = 0.0F;
  };
  /// In radians: what is certainly open between `lid` and `to` and above `top`; what is certainly hidden between `from` and `to`;
  /// and what may be open between `lid` and `to`, a huge number unless facets hide all between `lid` and `from`.
  struct Sky {
    float open, hidden, most;
  };
  /// For gaps of a packet of the group, in the order of their wedges. The facets are the same for all of the group.
  [[nodiscard]] std::span<const Sky> find(std::span<const Gap> gaps, const OverhangFacets& facets, const WedgeShape& shape,
                                          SkyWeight weight, const ReceiverPacket& receivers);

 private:
  void put(std::span<const Gap> gaps, const ReceiverPacket& receivers, WedgeGapBlock& block) const;

  const AzimuthSampling& azimuths_;
  FacetsInSight in_sight_;
  // Working memory, kept from packet to packet
  std::vector<Sky> found_;
  std::vector<PacketHorizon::Row> room_;
};

}  // namespace farlod
