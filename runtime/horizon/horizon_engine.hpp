// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/horizon_jumps.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_group.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/residual_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "package/far_horizon.hpp"

namespace farlod {

/// A sky view factor, and the bounds that are certain for the same azimuths.
struct SvfInterval {
  float low = 0.0F, estimate = 0.0F, high = 0.0F;
};

/// The gaps below overhangs in which a packet's receivers may see sky: for each azimuth between two horizons, but not between two
/// others, `filled`.
struct Gaps {
  const PacketHorizon &from, &to;
  const PacketHorizon &filled_from, &filled_to;
  std::span<const PacketHorizon::Row> sky;  ///< view factor of each gap; 0 where there is none
};

/// Removes the smallest gaps of a receiver, of no more sky than `max_sky` in all, and returns their sky.
[[nodiscard]] float remove_smallest_gaps(std::span<PacketHorizon::Row> sky, std::size_t lane, float max_sky);

/// Traces rays in the gaps of the receivers with set bits, and returns the sky that is seen through them. A gap that is all of
/// its azimuth's sky gets `rays_per_azimuth` rays, a smaller one its share, and at least one. Throws Cancelled when
/// `stop` is asked for.
[[nodiscard]] PacketHorizon::Lanes trace_gaps(const Gaps& gaps, const AzimuthSampling& azimuths, SkyWeight weight,
                                              const ReceiverPacket& receivers, std::uint32_t wanted, std::size_t rays_per_azimuth,
                                              const PlacedScene& scene, const std::stop_token& stop = {});

/// The answers of a packet, in the order of its receivers.
struct PacketAnswer {
  std::array<SvfInterval, ReceiverPacket::lanes> svf{};
  std::uint32_t by_rays = 0;  ///< a bit for each receiver that needed rays
};

/// Where the sum over the azimuths takes horizons to jump from one edge to another.
enum class JumpPlaces : std::uint8_t {
  between_azimuths,  ///< in the middle between two azimuths
  at_edge_ends       ///< where the edges end: HorizonJumps
};

/// How gaps are treated.
struct GapSettings {
  /// A receiver with at most so much sky in its gaps needs no rays: half of it counts.
  float tolerance = 0.0F;
  std::size_t rays_per_azimuth = 4;
  std::stop_token stop = {};  ///< ends the tracing of gaps with Cancelled
};

/// Sky view factors from horizons: edges are drawn for each receiver, and the sky above them is integrated in closed form. For
/// receivers of one cell. docs/concepts.md, "Above a horizon" and "What is grounded, and what overhangs".
class HorizonEngine {
 public:
  /// All must outlive it.
  HorizonEngine(const AzimuthSampling& azimuths, SkyWeight weight, const FarHorizon& far, const CellSilhouettes& silhouettes,
                OverhangGeometry& overhangs, const GapSettings& gaps, JumpPlaces jumps = JumpPlaces::at_edge_ends);

  /// Computes the receivers of packets near each other; low = estimate = high. The answers do not depend on which packets are
  /// together.
  void evaluate(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers);
  /// The same with bounds.
  void evaluate_with_bounds(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers);

 private:
  using Lanes = PacketHorizon::Lanes;
  /// Draws the grounded horizons of all packets, above those that `begin(packet, horizon)` makes, and finds the overhangs above
  /// them.
  template <class Begin>
  void draw_grounded(std::span<const ReceiverPacket> packets, const Begin& begin);
  /// Answers one packet, whose grounded horizon is drawn.
  void evaluate(const ReceiverPacket& receivers, PacketAnswer& answer);
  void evaluate_with_bounds(const ReceiverPacket& receivers, PacketAnswer& answer);
  /// The sky seen in gaps, and a bit for each receiver that needed rays for it.
  struct SkyInGaps {
    Lanes sky{};
    std::uint32_t by_rays = 0;
  };
  /// The sky above a horizon of upper borders, with its jumps where `jump_places_` says.
  [[nodiscard]] HorizonJumps::SkyAbove sky_above(const PacketHorizon& horizon, const ReceiverPacket& receivers);
  /// Of the gaps in `horizons_`, as drawn.
  [[nodiscard]] SkyInGaps sky_in_gaps(const ReceiverPacket& receivers);

  const AzimuthSampling& azimuths_;
  SkyWeight weight_;
  const CellSilhouettes& silhouettes_;
  OverhangGeometry& overhangs_;
  GapSettings gaps_;
  JumpPlaces jump_places_;
  ResidualHorizon residual_;
  PacketGroup group_;
  HorizonJumps jumps_;
  // Working memory, kept from packet to packet
  std::vector<PacketHorizon> grounded_;  ///< of each packet
  CellOverhangs in_sight_;               ///< overhangs that may rise above some of them
  OverhangHorizons horizons_;
  PacketHorizon without_residual_;
  std::vector<PacketHorizon::Row> gap_rows_;
};

}  // namespace farlod
