// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/exact_sky.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_envelope.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/residual_horizon.hpp"
#include "horizon/wedge_edges.hpp"
#include "horizon/wedge_gaps.hpp"
#include "scene/ray_scenes.hpp"

namespace farlod {

/// What bounds add for the rounding of coordinates and sums in floats: docs/concepts.md, "Bounds of a sky view factor".
inline constexpr double rounding_of_bounds = 2e-5;
/// Edges leave bounds no farther apart, as long as nothing else does: less would cost more.
inline constexpr double wanted_width = 0.005;

/// How far estimates may be from the ends of their bounds. Where edges, the far map and gaps leave more open, the whole city
/// tells.
struct AllowedError {
  double error = 0.0;
  const WholeCityOnDemand& city;
  Cell cell;                  ///< that of the receivers
  std::stop_token stop = {};  ///< ends the evaluation with Cancelled
};

/// Bounds of sky view factors between which the true value of the whole city lies, whatever there is between the azimuths.
/// docs/concepts.md, "Bounds of a sky view factor".
class CertainSky {
 public:
  using Lanes = PacketHorizon::Lanes;

  /// All must outlive it. The azimuths are even, at least PacketEnvelope::least_azimuths of them.
  CertainSky(const AzimuthSampling& azimuths, SkyWeight weight, const CellSilhouettes& silhouettes,
             const ResidualHorizon& residual, OverhangGeometry& overhangs);
  /// From now on, the ends of bounds are no farther than this from the estimates.
  void keep(const AllowedError& allowed);

  /// Begins a group of packets, whose horizons are those of grounded edges alone.
  void begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> grounded);

  /// `decided`: a bit for each receiver of whom wedges were decided by the whole city; so many wedges in all.
  struct Bounds {
    Lanes low{}, high{};
    std::uint32_t decided = 0;
    std::uint64_t wedges = 0;
  };
  /// For a packet of the group, its horizons and its estimates. For receivers in recesses, only the whole city knows bounds.
  [[nodiscard]] Bounds bounds(const NearHorizons& near, const ReceiverPacket& receivers, const Overhead& overhead,
                              const Lanes& estimates);

 private:
  /// What is known of a packet by its horizon, before rounding.
  struct Open {
    PacketEnvelope::Bounds sky;
    PacketEnvelope::Sums gaps{};
    [[nodiscard]] double high(std::size_t lane) const { return sky.high[lane] + gaps[lane]; }
    /// How far the farther end is from a value between both, or from the nearer one.
    [[nodiscard]] double farther_end_from(double value, std::size_t lane) const;
  };
  /// Whether something is in the group's sight.
  [[nodiscard]] bool has_overhangs(const NearHorizons& near) const { return near.has_upper_borders() || !far_.overhangs.empty(); }
  [[nodiscard]] bool has_undersides() const { return !near_undersides_.empty() || !far_.undersides.empty(); }
  /// Those above a grounded horizon, near and far. The far ones are in `upper_`.
  [[nodiscard]] std::vector<const DrawnEdges*> drawn_overhangs(const NearHorizons& near) const;
  [[nodiscard]] PacketEnvelope::Sums most_in_gaps(const NearHorizons& near, const ReceiverPacket& receivers, std::uint32_t below);
  /// Finds the wedges in which sky may be seen under an overhang, and the lower borders of the far map that count there.
  void choose_gaps(const NearHorizons& near, std::uint32_t below);
  /// Rows of wedges, at least those of the far map.
  [[nodiscard]] std::span<const PacketHorizon::Row> lower_borders(const NearHorizons& near, const ReceiverPacket& receivers);
  [[nodiscard]] Open open_sky(const NearHorizons& near, const ReceiverPacket& receivers, const Overhead& overhead);
  [[nodiscard]] PacketEnvelope::Bounds sky_above_borders(const NearHorizons& near, const ReceiverPacket& receivers);
  /// Lists the gaps of which facets may tell something, by what is known of grounded edges and of the far city.
  void list_gaps(const NearHorizons& near, const ReceiverPacket& receivers, const Open& open, const Overhead& overhead);
  /// Rows of wedges: slopes above which no overhang of the far city rises.
  void find_far_tops(const NearHorizons& near, const ReceiverPacket& receivers);
  /// Above an overhang overhead there is no sky.
  void close_above(const Overhead& overhead, Open& open);
  /// Narrows what is known by what facets leave open, and hide, in the gaps that were listed.
  void narrow_by_facets(const ReceiverPacket& receivers, const Overhead& overhead, Open& open);
  /// The terms of a receiver's wedges (PacketEnvelope::Terms).
  struct OpenWedges {
    const PacketEnvelope& envelope;
    const std::vector<std::uint8_t>& reached;
    std::size_t lane;
    double most_in_recess;  ///< of a wedge, where the receiver is in one; else 0
    [[nodiscard]] double low(std::size_t k) const { return static_cast<double>(envelope.terms().low[k][lane]); }
    [[nodiscard]] double high(std::size_t k) const { return static_cast<double>(envelope.terms().high[k][lane]); }
    [[nodiscard]] double gap(std::size_t k) const {
      if (most_in_recess > 0.0) return most_in_recess;
      return reached[k] == 0 ? 0.0 : static_cast<double>(envelope.terms().gaps[k][lane]);
    }
    [[nodiscard]] double width(std::size_t k) const;
    [[nodiscard]] std::vector<std::size_t> widest_first() const;
  };
  /// The term of a wedge by the whole city.
  [[nodiscard]] double exact_term(const ReceiverPacket& receivers, std::size_t lane, const Overhead& overhead, std::size_t wedge);
  [[nodiscard]] double term_of(double sky, std::size_t wedge, const ReceiverPacket& receivers, std::size_t lane,
                               const Overhead& overhead) const;
  /// Decides wedges of a receiver by the whole city, the widest first, until its bounds are close enough to its estimate.
  void decide(const ReceiverPacket& receivers, std::size_t lane, const Overhead& overhead, double estimate, Open& open,
              Bounds& bounds);
  /// The most that a wedge of a receiver in a recess may see of the sky.
  [[nodiscard]] double most_in_recess(const ReceiverPacket& receivers, std::size_t lane, const Overhead& overhead) const;

  const CellSilhouettes& silhouettes_;
  BorderEnds lower_ends_;
  const ResidualHorizon& residual_;
  OverhangGeometry& overhangs_;
  SkyWeight weight_;
  std::optional<AllowedError> allowed_;
  double wanted_;
  std::optional<ExactSky> exact_;  ///< once it is asked
  PacketGroup group_;
  PacketEnvelope envelope_;
  WedgeGaps wedge_gaps_;
  // What the group sees
  SilhouetteEdges near_undersides_{EdgeRole::underside};
  OverhangEdges far_;
  EndPlaces lower_places_, far_places_;  ///< of lower borders, and of the far city's overhangs
  // Working memory, kept from packet to packet
  ResidualHorizon::InWedges in_wedges_;
  PacketHorizon upper_, lower_, above_far_;
  const PacketHorizon* upper_borders_ = nullptr;  ///< of the packet, near and far
  EndPlaces places_;                              ///< of upper borders; the further ones are those of overhangs
  PacketEnvelope::Rows tops_;                     ///< of the upper ends that count so far
  PacketEnvelope::Rows far_tops_;
  std::vector<WedgeGaps::Gap> gaps_;
  DrawnEdges grounded_, overhangs_above_;  ///< those that may rise in some wedge
  std::vector<std::uint8_t> reached_;      ///< wedges in which sky may be seen under an overhang
  std::vector<std::uint8_t> may_hide_;
  std::vector<PacketHorizon::Row> chosen_borders_;
  std::span<const PacketHorizon::Row> residual_borders_;  ///< rows of wedges: the far map's
  std::span<const PacketHorizon::Row> lower_borders_;     ///< and all that count
};

}  // namespace farlod
