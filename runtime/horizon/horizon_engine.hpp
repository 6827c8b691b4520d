// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "horizon/azimuth_sampling.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/certain_sky.hpp"
#include "horizon/gap_sections.hpp"
#include "horizon/horizon_jumps.hpp"
#include "horizon/overhangs.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/pixel_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/recesses.hpp"
#include "horizon/residual_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "horizon/sky_profile.hpp"
#include "package/far_map.hpp"

namespace farlod {

/// The answers of a packet, in the order of its receivers.
struct PacketAnswer {
  std::array<SvfInterval, ReceiverPacket::lanes> svf{};
  /// What the profiles hold that OnProfile is told, and what the far map and gaps may change at their azimuths: with bounds
  /// alone.
  std::array<SvfInterval, ReceiverPacket::lanes> drawn{};
  std::uint32_t by_rays = 0;         ///< a bit for each receiver that the whole city decided
  std::uint64_t decided_wedges = 0;  ///< that the whole city decided because of an AllowedError
};

/// Where the sum over the azimuths takes horizons to jump from one edge to another.
enum class JumpPlaces : std::uint8_t {
  between_azimuths,  ///< in the middle between two azimuths
  at_edge_ends       ///< where the edges end: HorizonJumps
};

/// Sky view factors from horizons: edges are drawn for each receiver, and the sky above them is integrated in closed form. In
/// gaps below overhangs, it is what their facets leave open. For receivers of one cell. docs/concepts.md, "Above a horizon" and
/// "What is grounded, and what overhangs".
class HorizonEngine {
 public:
  /// All must outlive it. Of a receiver whose gaps together have no more sky than `gap_tolerance` times what it sees above its
  /// horizons, they are estimated: the error is less than that.
  HorizonEngine(const AzimuthSampling& azimuths, SkyWeight weight, const FarHorizon& far, const CellSilhouettes& silhouettes,
                OverhangGeometry& overhangs, float gap_tolerance, JumpPlaces jumps = JumpPlaces::at_edge_ends);
  /// From now on, evaluate_with_bounds keeps this error.
  void keep(const AllowedError& allowed) {
    allowed_error_ = static_cast<float>(allowed.error);
    certain().keep(allowed);
  }
  /// From now on, grounded horizons are those of a city that is nothing but pixels, of packets that it has made. Such horizons
  /// have no bounds.
  void see(PixelHorizon& pixels) { pixels_ = &pixels; }
  /// From now on, calls `on_profile(n, profile)` for each packet when its answer is known, with its number in the call, and what
  /// its answer is the estimate of, which may be swapped with another profile of these azimuths. Bounds do not change it. With
  /// SkyWeight::solid_angle it has no rows of sky by the cosine. Only with jumps at the ends of edges.
  using OnProfile = std::function<void(std::size_t n, SkyProfile& profile)>;
  void tell_profiles(ProfileRows rows, OnProfile on_profile);

  /// Computes the receivers of packets near each other; low = estimate = high. The answers do not depend on which packets are
  /// together.
  void evaluate(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers);
  /// The same with bounds, between which the true values lie; for a sampling that CertainSky takes.
  void evaluate_with_bounds(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers);

 private:
  using Lanes = PacketHorizon::Lanes;
  /// Draws the grounded horizons of all packets, above those that `begin(packet, horizon)` makes, and finds the overhangs above
  /// them.
  template <class Begin>
  void draw_grounded(std::span<const ReceiverPacket> packets, PacketHorizon::Edges edges, const Begin& begin);
  /// Answers one packet, whose grounded horizon is drawn.
  void evaluate(const ReceiverPacket& receivers, PacketAnswer& answer);
  void evaluate_with_bounds(const ReceiverPacket& receivers, PacketAnswer& answer);
  /// The near overhangs may be drawn already.
  void evaluate(const ReceiverPacket& receivers, const Overhead& overhead, PacketAnswer& answer,
                const NearHorizons* near = nullptr);
  /// Overhangs that may rise above horizons: all of them above those of receivers in recesses, which are lower than others.
  [[nodiscard]] const CellOverhangs& in_sight(const Overhead& overhead) const {
    return overhead.in_recess != 0 ? silhouettes_ : in_sight_;
  }
  /// The sky above a horizon of upper borders, with its jumps where `jump_places_` says.
  [[nodiscard]] HorizonJumps::SkyAbove sky_above(const PacketHorizon& horizon, const ReceiverPacket& receivers,
                                                 const Overhead& overhead);
  /// The sky in the gaps of `horizons_`, as drawn, for receivers that see so much sky `above` them.
  [[nodiscard]] Lanes sky_in_gaps(const ReceiverPacket& receivers, const Overhead& overhead, const Lanes& above);
  /// What the facets leave open of the gaps of those receivers that are asked for.
  [[nodiscard]] std::span<const OpenGap> open_gaps(const ReceiverPacket& receivers, const Overhead& overhead,
                                                   std::uint32_t asked);
  /// What is known of a profile at the estimate of a horizon, but for its sky; and of the gaps below it.
  void begin_profile(const PacketHorizon& horizon);
  void profile_gaps(std::span<const OpenGap> open, std::uint32_t asked, const ReceiverPacket& receivers);

  /// The sky at the azimuths of a profile, at least and at most, of `near_`.
  struct SkyAtAzimuths {
    Lanes low{}, high{};
  };
  [[nodiscard]] SkyAtAzimuths bounds_at_azimuths(const ReceiverPacket& receivers, const Overhead& overhead);
  CertainSky& certain();

  const AzimuthSampling& azimuths_;
  SkyWeight weight_;
  const CellSilhouettes& silhouettes_;
  OverhangGeometry& overhangs_;
  float gap_tolerance_;
  JumpPlaces jump_places_;
  PixelHorizon* pixels_ = nullptr;
  float allowed_error_ = 1.0F;
  std::optional<SkyProfile> profile_;  ///< if somebody wants to know
  OnProfile on_profile_;
  ProfileRows profile_rows_;
  ResidualHorizon residual_;
  PacketGroup group_;
  Recesses recesses_;
  HorizonJumps jumps_;
  GapSections sections_;
  // Working memory, kept from packet to packet
  std::vector<PacketHorizon> grounded_;  ///< of each packet
  CellOverhangs in_sight_;               ///< overhangs that may rise above some of them
  OverhangHorizons horizons_;
  NearHorizons near_;
  std::vector<PacketHorizon::Row> gap_rows_;
  Lanes corrections_{};                ///< of the estimate, by its jumps
  std::optional<CertainSky> certain_;  ///< once somebody asks for bounds
};

}  // namespace farlod
