// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/evaluation.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/picture_plane.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/silhouette_edges.hpp"
#include "horizon/wedge_edges.hpp"
#include "horizon/wedge_envelope.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {

/// Bounds of the sky of a packet's receivers that hold between the azimuths, too: the sky above the upper envelope of edges,
/// wedge by wedge. docs/concepts.md, "The sky of a wedge".
class PacketEnvelope {
 public:
  using Row = PacketHorizon::Row;
  using Rows = std::vector<Row>;
  using Sums = std::array<double, ReceiverPacket::lanes>;
  static constexpr std::size_t least_azimuths = 8;

  /// The azimuths are even, at least so many. `ends` has the numbers of all edges. Both must outlive it.
  PacketEnvelope(const AzimuthSampling& azimuths, SkyWeight weight, const BorderEnds& ends);

  /// Begins with a horizon of edges alone, which it tracks. All that follows is above it; both must outlive that.
  void see(const PacketHorizon& horizon, const ReceiverPacket& receivers);
  /// Rows of wedges: tops = max(tops, the slope of each end), in the wedge where each receiver sees it: at least where that is
  /// above the lower one of both horizons.
  void raise_to_ends(std::span<const EndBatch> ends, std::span<Row> tops);

  /// A slope above which neither the horizon nor these ends rise in a wedge.
  [[nodiscard]] float most(std::span<const Row> tops, std::size_t k, std::size_t lane) const {
    return shape_.widened * std::max({tops[k][lane], slope_at(k, lane), slope_at(next(k), lane)});
  }

  /// A slope below which edges hide all of a wedge that has a gap, after most_in_gaps().
  [[nodiscard]] float lid(std::size_t k, std::size_t lane) const {
    return has_bit(others_[k], lane) ? lids_[k][lane] : lower_[k][lane];
  }

  /// What hides the sky. All of it must outlive the call.
  struct Occluders {
    /// The edges of the horizon, which hide all that is below them; without those that are no higher than it in any of their
    /// wedges.
    DrawnLists edges;
    std::span<const Row> tops;  ///< of their ends, as raise_to_ends() makes them
  };
  /// What hides the sky besides, in rows of wedges: below `least` no sky is seen, and above `most` nothing hides it.
  struct Hiding {
    std::span<const Row> least, most;
  };
  struct Bounds {
    Sums low{}, high{};
  };
  /// Bounds of the sky above the envelope, `wanted` apart where edges are what keeps them apart.
  [[nodiscard]] Bounds bounds(const Occluders& occluders, const Hiding& hiding, double wanted);

  /// Where sky may be seen under an overhang.
  struct Gaps {
    std::span<const Row> borders;           ///< rows of wedges: it is below them
    std::span<const std::uint8_t> reached;  ///< the wedges that count; there it may also be between edges
  };
  /// How much sky lies between the edges, with these tops, and the borders, at most.
  [[nodiscard]] Sums most_in_gaps(std::span<const Row> tops, const Gaps& gaps);
  /// How much of a wedge's gap, as that found it, lies below a slope: the sky between an edge and the slope, in radians, where
  /// that is known to the last digit.
  [[nodiscard]] float open_below(float slope, float border, std::size_t k, std::size_t lane) const {
    const bool is_known = wedge_weight_ == WedgeWeight::cosine_up && !has_bit(others_[k], lane) && slope < border;
    return is_known ? std::max(0.0F, terms_.gaps[k][lane] - level_sky_between(slope, border)) : 0.0F;
  }
  /// Rows of the wedges that count: the lower borders with these ends above the horizon, or `others` where these are higher.
  [[nodiscard]] std::span<const Row> find_lower_borders(std::span<const EndBatch> ends, const PacketHorizon& lower_borders,
                                                        const Gaps& others);

  /// Rows of wedges, of the last call of either: their terms in it. By the cosine, but for packets that look up, what cancels
  /// from wedge to wedge is left out, as `term_of` does after bounds().
  struct Terms {
    Rows low, high;  ///< after keep_terms(true)
    Rows gaps;       ///< where some are reached
  };
  void keep_terms(bool keeps) { has_terms_ = keeps; }
  [[nodiscard]] const Terms& terms() const { return terms_; }
  [[nodiscard]] Terms& terms() { return terms_; }
  [[nodiscard]] double term_of(double sky, std::size_t k, const ReceiverPacket& receivers, std::size_t lane) const;
  [[nodiscard]] const Wedge& wedge(std::size_t k) const { return wedges_[k]; }
  [[nodiscard]] const WedgeShape& shape() const { return shape_; }
  /// What a receiver that looks straight up sees of a wedge between two slopes, in radians.
  [[nodiscard]] float level_sky_between(float low, float high) const {
    return shape_.angle / (1.0F + low * low) - shape_.angle / (1.0F + high * high);
  }
  [[nodiscard]] std::size_t size() const { return wedges_.size(); }
  /// LowerHorizons::minima.
  [[nodiscard]] const float* least_horizons() const { return minima_.data(); }

 private:
  /// A wedge that is not simple for a receiver: what is known of it.
  struct Doubt {
    std::uint32_t wedge;
    PairsAnswer& pairs;
    std::size_t n;  ///< the wedge among the pairs
    [[nodiscard]] bool is_unknown() const { return has_bit(pairs.unknown, n); }
    [[nodiscard]] float width() const { return pairs.high[n] - pairs.low[n]; }
  };
  struct WidthOfDoubt {
    float width;
    std::size_t n;  ///< the doubt
  };
  /// One receiver of the packet.
  struct Eye {
    std::span<const Row> tops;
    const Hiding& hiding;
    std::size_t lane;
    Point3f p;
    Point3d normal;
  };
  [[nodiscard]] Eye eye_of(std::span<const Row> tops, const Hiding& hiding, std::size_t lane) const;

  SimpleSums sum_simple(std::span<const Row> tops, const Hiding& hiding);
  /// Those with bits, and all that are asked for who looks down.
  void list_doubtful_wedges(const std::uint8_t* asked);
  /// Calls answer(wedges, pairs) for sixteen doubtful wedges at once.
  template <class Answer>
  void visit_pairs(const Eye& eye, const Answer& answer);
  void find_doubts(const Eye& eye);
  /// Sets the terms of gaps in these wedges, below borders that are rows of wedges.
  void bound_gaps(const Eye& eye, std::span<const Row> borders);
  void put_pair(const Eye& eye, std::size_t k, std::size_t n, WedgePairs& pairs) const;
  void put_edge(const Eye& eye, std::int32_t number, std::size_t k, std::size_t n, EdgesSeen& edges) const;
  void put_plane(const Eye& eye, std::int32_t number, std::size_t k, std::size_t n, EdgesSeen& edges) const;
  /// A bit for each of these wedges that only all edges tell of.
  [[nodiscard]] std::uint32_t beyond_pairs(const Eye& eye, std::span<const std::uint32_t> wedges) const;
  [[nodiscard]] std::span<const std::uint32_t> doubtful(std::size_t lane) const {
    return std::span(doubtful_).subspan(lane * wedges_.size(), doubtful_count_[lane]);
  }
  /// The doubts of a receiver, after find_doubts().
  [[nodiscard]] Doubt doubt(std::size_t lane, std::size_t n) {
    return {doubtful(lane)[n], pairs_[n / packet_lanes], n % packet_lanes};
  }
  void resolve_doubts(const Eye& eye, double width, double wanted);
  void resolve(const Eye& eye, const Doubt& doubt);
  [[nodiscard]] WedgeEye wedge_eye(const Eye& eye, const Doubt& doubt, const EdgesInWedges::InWedge& edges) const;
  void find_edges_above(const WedgeEye& seen, const EdgesInWedges::InWedge& edges);
  void find_sky(const Eye& eye, const EdgesInWedges::InWedge& edges, const Doubt& doubt);
  void add_level(const Wedge& wedge, double first, double last);
  void add_edges(const Eye& eye, const EdgesInWedges::InWedge& edges, std::size_t k);
  void keep_terms_of(std::size_t lane);

  [[nodiscard]] std::size_t next(std::size_t k) const { return k + 1 < wedges_.size() ? k + 1 : 0; }
  [[nodiscard]] std::int32_t number_at(std::size_t k, std::size_t lane) const {
    return numbers_[k * ReceiverPacket::lanes + lane];
  }
  [[nodiscard]] float slope_at(std::size_t k, std::size_t lane) const { return slopes_[k * ReceiverPacket::lanes + lane]; }
  [[nodiscard]] LowerHorizons lower_horizons() { return {lower_.front().data(), minima_.data()}; }

  const AzimuthSampling& azimuths_;
  SkyWeight weight_;
  const BorderEnds& ends_;
  std::vector<Wedge> wedges_;
  WedgeShape shape_{};
  WedgeEnvelope envelope_;
  EdgesInWedges edges_;
  bool has_terms_ = false;
  Terms terms_;
  Rows none_;  ///< hides nothing
  // Working memory, kept from packet to packet
  const PacketHorizon* horizon_ = nullptr;
  const ReceiverPacket* receivers_ = nullptr;
  WedgeWeight wedge_weight_ = WedgeWeight::cosine_up;
  const float* slopes_ = nullptr;  ///< of the horizon, raised to the receivers' own planes
  const std::int32_t* numbers_ = nullptr;
  Rows own_slopes_;
  std::vector<std::int32_t> own_numbers_;
  Rows lower_, borders_;
  Rows lids_;  ///< of wedges with gaps that are not simple
  std::vector<float> minima_;
  std::vector<std::uint16_t> others_;    ///< a bit for each receiver for whom a wedge is not simple
  std::vector<std::uint32_t> doubtful_;  ///< these wedges, receiver by receiver
  std::array<std::size_t, ReceiverPacket::lanes> doubtful_count_{};
  std::vector<PairsAnswer> pairs_;    ///< of the doubts of one receiver
  std::vector<WidthOfDoubt> widest_;  ///< a heap
  std::vector<std::uint32_t> above_;
};

}  // namespace farlod
