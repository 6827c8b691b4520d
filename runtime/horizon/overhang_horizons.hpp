// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_ring.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// Where sky may be seen below what is far and has several lower borders one above the other.
enum class FarGaps : std::uint8_t {
  possible,  ///< below the highest of them
  estimate     ///< below the lowest of them: what is above is one building's
};

/// Between which slopes a packet's receivers may see sky, where something overhangs. docs/concepts.md, "What is grounded, and
/// what overhangs".
struct OverhangHorizons {
  explicit OverhangHorizons(const AzimuthRing& ring)
      : grounded(ring), borders(ring), upper(ring), far_borders(ring), far_upper(ring) {}

  PacketHorizon grounded;                ///< below them no sky is seen
  PacketHorizon borders;                 ///< between them and `upper` none either
  PacketHorizon upper;                   ///< above them all is sky
  PacketHorizon far_borders, far_upper;  ///< of the far city alone: between them there is no sky either

  /// Draws what overhangs over `grounded`; `covered` are the bits of the receivers that have something overhead. `borders` and
  /// `upper` may hold what is known of the residual horizon already; they must not be lower than `grounded`.
  void draw_overhangs(const CellSilhouettes& silhouettes, const ReceiverPacket& receivers, std::uint32_t covered, FarGaps far_gaps);
  /// How much sky lies between `grounded` and `borders`, a row for each azimuth; none where there is nothing. Afterwards
  /// `borders` and the far horizons tell of that sky alone.
  [[nodiscard]] std::span<const PacketHorizon::Row> find_sky_below_borders(SkyWeight weight, const ReceiverPacket& receivers,
                                                                           std::vector<PacketHorizon::Row>& rows);

 private:
  std::vector<PacketHorizon::Row> filled_;
};

}  // namespace farlod
