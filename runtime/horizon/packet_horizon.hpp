// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/drawn_edges.hpp"
#include "horizon/kernels.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// The horizons of a packet of receivers: for each azimuth of a sampling the slope (tangent of the elevation, at least 0) below
/// which no sky is seen. docs/concepts.md, "Above a horizon".
class PacketHorizon {
 public:
  using Lanes = ReceiverPacket::Lanes;
  struct alignas(64) Row : Lanes {};  ///< a value for each receiver

  /// Whether a horizon knows which edge it belongs to at each azimuth; and also which edges may rise above it between two.
  enum class Edges : std::uint8_t { unknown, numbered, tracked };

  /// The sampling must outlive it. All horizons are level.
  explicit PacketHorizon(const AzimuthSampling& azimuths, Edges edges = Edges::unknown)
      : azimuths_(&azimuths),
        edges_(edges),
        slopes_(azimuths.size()),
        numbers_(edges == Edges::unknown ? 0 : azimuths.size(), no_edges()) {}

  /// Makes all horizons level again.
  void clear();
  /// The same, and from now on numbers their edges, or tracks them. They must not have been unknown.
  void clear(Edges edges) {
    edges_ = edges;
    clear();
  }
  /// Raises each receiver's horizon to the edges that it sees. Fastest if edges come from near to far, since edges below the
  /// horizons of all receivers are culled.
  void raise(const SilhouetteEdges& edges, const ReceiverPacket& receivers) {
    raise(edges, receivers, bounds_of(receivers), Culling::nothing_drawn);
  }
  /// The same, with the bounds of these receivers.
  void raise(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketBounds& bounds, Culling culling);
  /// Sets each horizon to the lowest of the edges that the receiver sees above `min_horizon`, or to `min_horizon` where it sees
  /// none.
  void set_to_lowest(const SilhouetteEdges& edges, const ReceiverPacket& receivers, const PacketHorizon& min_horizon);
  /// Raises the horizons to slopes given for the bins of a far map, each receiver's to at most its cap: infinite for the
  /// receivers that are meant, 0 for the others.
  void raise(std::span<const float> row, const Lanes& caps, std::span<const std::uint32_t> bin_of_azimuth);
  /// The same to here + share (above − here), with a share for each receiver, clamped to [lower, upper].
  void raise(const ResidualRows& rows, std::span<const std::uint32_t> bin_of_azimuth);
  /// Raises them to other horizons where these are higher, which track their edges if these do; or lowers them where these are
  /// lower.
  void raise_to(const PacketHorizon& other);
  void lower_to(const PacketHorizon& other);
  /// Raises them to `upper` where `lower` is not above them: an occluder that begins below a horizon, and reaches above it
  /// without a gap, is one with it.
  void join(const PacketHorizon& lower, const PacketHorizon& upper);
  /// Lowers the horizon of one receiver at one azimuth, if it is higher.
  void lower(std::size_t azimuth, std::size_t lane, float slope) {
    slopes_[azimuth][lane] = std::min(slopes_[azimuth][lane], slope);
  }
  /// Makes the horizons of the receivers with set bits infinite: they see no sky.
  void close(std::uint32_t receivers);

  /// Makes the horizon of one receiver its other one, or raises it to that. `other` tracks its edges. Those that it has drawn are
  /// not among drawn().
  void copy_lane(std::size_t lane, const PacketHorizon& other) {
    for (std::size_t k = 0; k < slopes_.size(); ++k) slopes_[k][lane] = other.slopes_[k][lane];
    for (std::size_t k = 0; k < numbers_.size(); ++k) numbers_[k][lane] = other.numbers_[k][lane];
  }
  void raise_lane(std::size_t lane, const PacketHorizon& other) {
    for (std::size_t k = 0; k < slopes_.size(); ++k) {
      if (other.slopes_[k][lane] <= slopes_[k][lane]) continue;
      slopes_[k][lane] = other.slopes_[k][lane];
      if (!numbers_.empty()) numbers_[k][lane] = other.numbers_[k][lane];
    }
  }
  /// Makes the slopes those of other horizons; of which edges they are is unknown.
  void set_slopes(const PacketHorizon& other);
  /// Makes the slopes those of other horizons, and the edges at the azimuths; drawn() is what is drawn from now on, if the others
  /// track their edges.
  void begin_above(const PacketHorizon& other);
  /// The number of the edge (SilhouetteEdges::number) that a horizon belongs to; −1 if it is that of a far map, or level. Of
  /// horizons that track their edges, and that were raised since then by edges and estimates alone.
  [[nodiscard]] std::int32_t edge_number(std::size_t azimuth, std::size_t lane) const { return numbers_[azimuth][lane]; }
  [[nodiscard]] bool tracks_edges() const { return edges_ == Edges::tracked; }
  /// The edges that were drawn, of horizons that track theirs: among them are all of those lists that rise somewhere in a wedge
  /// above the lower one of both horizons. Others may be there, too.
  [[nodiscard]] const DrawnEdges& drawn() const { return drawn_; }
  /// The edge numbers of all, as kernels.hpp has them.
  [[nodiscard]] const std::int32_t* numbers() const { return numbers_.front().data(); }
  /// Where horizons that number their edges go from one edge to another, and the sky of the azimuths changes by more than
  /// `least`. Room for one at each azimuth; returns those that there are.
  [[nodiscard]] std::span<const SkyJump> find_jumps(std::span<const Row> sky_of_azimuths, float least,
                                                    std::span<SkyJump> room) const;
  /// slopes[azimuth][receiver], as kernels.hpp has them.
  [[nodiscard]] const float* slopes() const { return data(); }
  /// To draw them otherwise than by edges.
  [[nodiscard]] float* drawn_slopes() { return data(); }
  [[nodiscard]] const Row& row(std::size_t azimuth) const { return slopes_[azimuth]; }
  /// A bit for each receiver whose horizon is higher than its other one, at some azimuth.
  [[nodiscard]] std::uint32_t exceeds(const PacketHorizon& other) const;
  /// A bit for each receiver whose horizon lies below a slope at one azimuth.
  [[nodiscard]] std::uint32_t below(std::size_t azimuth, float slope) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) bits |= slopes_[azimuth][l] < slope ? 1U << l : 0U;
    return bits;
  }
  /// How many rays with these slopes, one at each azimuth, pass above each receiver's horizon.
  [[nodiscard]] Lanes count_above(std::span<const float> ray_slopes) const;
  /// The view factors of the sky above the horizons, for each receiver's normal, in [0, 1].
  [[nodiscard]] Lanes sky_above(SkyWeight weight, const ReceiverPacket& receivers) const {
    return sky_above(weight, receivers, {});
  }
  /// The same, and the sky of each azimuth by itself (F(φ) of docs/concepts.md), unless there are no rows for it.
  [[nodiscard]] Lanes sky_above(SkyWeight weight, const ReceiverPacket& receivers, std::span<Row> of_azimuths) const;
  /// For each azimuth, the view factor of the sky between these horizons and higher ones: as shares of the turn, so that over all
  /// azimuths they sum to the difference of both sky_above.
  void find_sky_below(const PacketHorizon& higher, SkyWeight weight, const ReceiverPacket& receivers,
                      std::vector<Row>& rows) const;

 private:
  [[nodiscard]] float* data() { return slopes_.front().data(); }
  [[nodiscard]] const float* data() const { return slopes_.front().data(); }

  struct alignas(64) Numbers : std::array<std::int32_t, ReceiverPacket::lanes> {};
  [[nodiscard]] static Numbers no_edges() {
    Numbers none;
    none.fill(-1);
    return none;
  }
  [[nodiscard]] std::int32_t* numbers() { return numbers_.empty() ? nullptr : numbers_.front().data(); }

  const AzimuthSampling* azimuths_;
  Edges edges_;
  std::vector<Row> slopes_;       ///< slopes_[azimuth][receiver]
  std::vector<Numbers> numbers_;  ///< of the edges, as many; empty if they are unknown
  DrawnEdges drawn_;
};

/// Draws edges for packets that are close to each other: most edges of a cell are culled once for all of them.
/// docs/concepts.md, "Culling edges for a packet".
class PacketGroup {
 public:
  /// The sampling must outlive it, and be that of all horizons.
  explicit PacketGroup(const AzimuthSampling& azimuths) : azimuths_(azimuths) {}

  /// Raises horizons[n] to the edges that the receivers of packets[n] see: to the bit what horizons[n].raise(edges, packets[n])
  /// does.
  void raise(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets, std::span<PacketHorizon> horizons);
  /// Makes `kept` the edges that may rise above one of these horizons, drawn for these packets: the others raise none of them,
  /// and none that is higher.
  void keep_raising(const SilhouetteEdges& edges, std::span<const ReceiverPacket> packets,
                    std::span<const PacketHorizon> horizons, RaisingAt where, SilhouetteEdges& kept);

 private:
  /// Finds the edges that may raise one of these horizons, of receivers within these bounds.
  void find_raising(const SilhouetteEdges& edges, const PacketBounds& bounds, std::span<const PacketHorizon> horizons,
                    RaisingAt where, std::vector<std::uint16_t>& raising);

  const AzimuthSampling& azimuths_;
  // Working memory, kept from group to group
  std::vector<std::uint16_t> first_, others_;  ///< a bit for each edge of each batch
  std::vector<PacketBounds> bounds_;
  std::vector<const float*> slopes_;
  SilhouetteEdges drawn_;
};

}  // namespace farlod
