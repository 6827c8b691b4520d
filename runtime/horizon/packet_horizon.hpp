// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_ring.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// The horizons of a packet of receivers: for each azimuth of a ring the slope (tangent of the elevation, at least 0) below which
/// no sky is seen. docs/concepts.md, "Above a horizon".
class PacketHorizon {
 public:
  using Lanes = ReceiverPacket::Lanes;
  struct alignas(64) Row : Lanes {};  ///< a value for each receiver

  /// The ring must outlive it. All horizons are level.
  explicit PacketHorizon(const AzimuthRing& ring) : ring_(&ring), slopes_(ring.size()) {}

  /// Makes all horizons level again.
  void clear();
  /// Raises the horizons to slopes given for the bins of a far map, each to its cap at the most: infinite for the receivers that
  /// are meant, 0 for the others.
  void raise(std::span<const float> row, const Lanes& caps, std::span<const std::uint32_t> bin_of_azimuth);
  /// Raises them likewise to slopes between two rows of bins, as much of the way from `here` to `above` as each one's share says,
  /// within the bounds.
  struct RowsBetween {
    std::span<const float> here, above, lower, upper;
    Lanes shares, caps;
  };
  void raise(const RowsBetween& rows, std::span<const std::uint32_t> bin_of_azimuth);
  /// Raises each receiver's horizon by what it sees of some edges: fastest if they come from near to far, since those that lie
  /// below the horizons of all receivers already are passed over.
  void raise(const SilhouetteEdges& edges, const ReceiverPacket& receivers);
  /// Lets those receivers see no sky at all whose bits are set.
  void close(std::uint32_t receivers);
  /// Raises them to other ones where these are higher.
  void raise_to(const PacketHorizon& other);
  /// Raises them to `upper` where `lower` is not above them: what begins below a horizon, and reaches above it without a gap, is
  /// one with it.
  void join(const PacketHorizon& lower, const PacketHorizon& upper);
  /// Lowers them to other ones where these are lower.
  void lower_to(const PacketHorizon& other);
  [[nodiscard]] const Row& row(std::size_t azimuth) const { return slopes_[azimuth]; }
  /// Becomes, for each receiver and azimuth, the lowest of some edges that is seen above `floors`; `floors` where none is.
  void become_lowest(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketHorizon& floors);
  /// Of directions with these slopes, one at each azimuth, how many pass over each receiver's horizon.
  [[nodiscard]] Lanes count_over(std::span<const float> slopes) const;
  /// A bit for each receiver whose horizon is higher than the other one of its own, at some azimuth.
  [[nodiscard]] std::uint32_t above(const PacketHorizon& other) const;
  /// A bit for each receiver whose horizon lies below a slope at one azimuth.
  [[nodiscard]] std::uint32_t below(std::size_t azimuth, float slope) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) bits |= slopes_[azimuth][l] < slope ? 1U << l : 0U;
    return bits;
  }
  /// The view factors of the sky above the horizons, for each receiver's normal, in [0, 1].
  [[nodiscard]] Lanes sky_above(SkyWeight weight, const ReceiverPacket& receivers) const;
  /// For each azimuth, the view factor of the sky between these horizons and higher ones: as shares of the turn, so that over all
  /// azimuths they sum to the difference of both sky_above.
  void find_sky_below(const PacketHorizon& higher, SkyWeight weight, const ReceiverPacket& receivers,
                      std::vector<Row>& rows) const;

 private:
  const AzimuthRing* ring_;
  std::vector<Row> slopes_;  ///< a row of receivers for each azimuth
};

}  // namespace farlod
