// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/kernels.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_partition.hpp"

namespace farlod {

/// The sky of a packet's receivers that the far map and overhangs leave undecided, azimuth by azimuth, and the rays that decide
/// it. docs/concepts.md, "Bounds of a sky view factor".
class UndecidedSky {
 public:
  using Lanes = PacketHorizon::Lanes;
  using Row = PacketHorizon::Row;

  /// The sampling must outlive it.
  explicit UndecidedSky(const AzimuthSampling& azimuths) : from(azimuths), to(azimuths), azimuths_(azimuths) {}

  /// The undecided slopes lie between these two: nothing below `from` is sky, and everything above `to` is.
  PacketHorizon from, to;

  /// How much of the sky between `from` and `to` is undecided, and how much of it is expected to be seen: for each azimuth, as
  /// shares of the turn. `estimate` lies between `from` and `to`.
  void measure(const PacketHorizon& estimate, SkyWeight weight, const ReceiverPacket& receivers);
  /// Adds the sky of gaps below overhangs, at most and by the estimate, half of which is expected to be seen: rows as
  /// OverhangHorizons has them, or none where there is no gap. Where there is one, `from` is lowered to `grounded`.
  void add_gaps(std::span<const Row> most, std::span<const Row> estimate, const PacketHorizon& grounded);
  /// Says below which slopes something may overhang in the far city: where that is above `from`, there may be gaps.
  void mark_gaps(const PacketHorizon& overhangs);

  /// What rays are for.
  struct Wanted {
    std::uint32_t receivers = 0;       ///< a bit for each
    double max_width = 0.0;            ///< how much sky may stay undecided
    std::size_t rays_per_azimuth = 1;  ///< of a gap that is all of its azimuth's sky
    std::stop_token stop = {};         ///< ends decide() with Cancelled
  };
  /// How much of the undecided sky each wanted receiver sees for certain, how much more it is expected to see, and how much is
  /// still undecided.
  struct Decided {
    std::array<double, ReceiverPacket::lanes> seen{}, expected{}, width{};
    std::uint64_t rays = 0;
  };
  /// Traces rays against the whole city until at most `max_width` is undecided, the widest azimuths first. Where there is no
  /// gap, the horizon lies between `from` and `to`, and each ray halves the sky in which it may be. Where there is one, what its
  /// rays see is the sky.
  [[nodiscard]] Decided decide(const Wanted& wanted, const PlacedScene& city, SkyWeight weight, const ReceiverPacket& receivers);

 private:
  /// Halving so often closes an interval, up to the rounding of floats.
  static constexpr int most_halvings = 20;
  /// For each receiver how often its interval is halved; in a gap, 0 if no rays are traced.
  struct Halvings : std::array<std::uint8_t, ReceiverPacket::lanes> {};
  /// The widths of one receiver's intervals.
  class Octaves;
  struct Tracing;

  [[nodiscard]] bool is_gap(std::size_t azimuth, std::size_t lane) const { return ((gaps_[azimuth] >> lane) & 1U) != 0; }
  /// Plans the least halvings of one receiver that leave `max_width`. Returns how often the widest interval is halved.
  int plan(std::size_t lane, double max_width);
  /// A bit for each receiver whose interval at an azimuth is halved more often than `step` times.
  [[nodiscard]] std::uint32_t halved_at(std::size_t azimuth, int step) const;
  void halve(std::size_t azimuth, const Tracing& tracing, Decided& decided);
  /// What is known of an azimuth after its halvings: `above_all` is the sky above all that was undecided, `ends` are of the rest.
  void store_halved(std::size_t azimuth, const Lanes& above_all, const GapEnds& ends, Decided& decided);
  void trace_gaps(const Tracing& tracing, Decided& decided);

  const AzimuthSampling& azimuths_;
  std::vector<Row> most_, expected_;
  std::vector<std::uint32_t> gaps_;  ///< for each azimuth, a bit for each receiver with a gap
  std::vector<Halvings> plan_;
  std::vector<Row> gap_sky_;  ///< between `from` and `to`, where rays are traced in gaps
};

}  // namespace farlod
