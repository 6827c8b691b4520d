// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "canopy/canopy_on_pixels.hpp"
#include "canopy/dimmed_sky.hpp"
#include "evaluate/crowns_of_cell.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/sky_directions.hpp"
#include "evaluate/traced_canopy.hpp"
#include "farlod/quantities.hpp"
#include "horizon/horizon_engine.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "package/crown.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"
#include "scene/ray_scenes.hpp"

namespace farlod {

/// What crowns do to the view of a receiver.
struct CanopyAnswer {
  CanopyLoss loss;
  SvfInterval svf_total;
};

/// The values of a receiver whose sky view factor is known, in the order of columns_of: as many as range_of_crowns says.
void write_canopy_columns(const Quantities& quantities, float svf, const CanopyAnswer& answer, std::span<float> values);

/// Stores what canopies do, of receivers whose svf is stored, by rays in their directions. Added to a place of the cell's frame,
/// `scene_from_cell_m` gives one of the scene's. Throws Cancelled when `stop` is asked for.
void store_traced_canopies(const CellReceivers& cell, const CanopyScene& scene, Point2d scene_from_cell_m,
                           const SkyDirections& directions, const FurtherQuantities& quantities, const SkyAnswers& answers,
                           const std::stop_token& stop);

/// What is known of the skies of a packet, whose receivers have these numbers in the cell and whose answers are stored.
using SkiesOfPacket = std::array<SkyOfReceiver, ReceiverPacket::lanes>;
[[nodiscard]] SkiesOfPacket skies_of(const PacketAnswer& packet, const CellReceivers& cell,
                                     std::span<const std::uint32_t> numbers, const SkyAnswers& answers);

/// How certain svf_total is to be.
struct CanopyCertainty {
  bool bounds = false;  ///< whether it has an interval
  /// How far answers may be from the ends of it: otherwise crowns count one by one, and where that is not enough, rays are
  /// traced.
  std::optional<double> max_error = std::nullopt;
  const WholeCityOnDemand* city = nullptr;    ///< what rays are traced against
  const SkyDirections* directions = nullptr;  ///< of these rays
};

/// What the crowns around a cell take of the view of its receivers, by profiles of the sky. Of one thread.
class CanopyAnswers {
 public:
  /// An answer for each receiver of a packet.
  using Answers = std::array<CanopyAnswer, ReceiverPacket::lanes>;

  /// All must outlive it. Where `pixels` are given, which are all crowns, receivers at their centres are answered by marches over
  /// them; there are no bounds then.
  CanopyAnswers(const PackageReader& package, const CellReceivers& cell, const FurtherQuantities& further,
                CanopyCertainty certainty, const CanopyCity* pixels, std::stop_token stop);

  /// Finds what crowns take of the sky of packets near each other. What follows is of these packets.
  void see(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets);
  /// Where crowns dim the sky of a packet, if a quantity needs it (FurtherQuantities::needs_dimmed_sky).
  [[nodiscard]] const DimmedSky& dimmed(std::size_t packet) const { return dimmed_[packet]; }
  /// The answers, valid until see() is called. CanopyLoss::building, which takes rays, is 0 where no quantity needs it.
  [[nodiscard]] std::span<const Answers> evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                                                  std::span<const SkiesOfPacket> skies);
  /// How many rays were traced against the whole city so far.
  [[nodiscard]] std::uint64_t retraced_rays() const { return retraced_rays_; }

 private:
  /// What is wanted of each azimuth of a packet: rows of the sky and of solid things behind crowns, or nothing.
  struct Rows {
    std::span<PacketHorizon::Row> behind, hidden;
  };
  [[nodiscard]] Rows rows_of(std::size_t packet);
  [[nodiscard]] CrownsOfCell& crowns();
  /// Nothing, where no quantity needs dimmed skies.
  [[nodiscard]] std::span<DimmedSky> wanted_of(std::vector<DimmedSky>& dimmed) const {
    return further_.needs_dimmed_sky() ? std::span(dimmed) : std::span<DimmedSky>();
  }
  void make_room(std::size_t packets);
  void march(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets);
  /// For the receivers that no march answers.
  void find_shares(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets);
  [[nodiscard]] Answers of_packet(std::size_t packet, const SkyProfile& profile, const ReceiverPacket& receivers,
                                  const SkiesOfPacket& skies);
  /// What of the sky and of solid things lies behind crowns in each half of the sky, and in all, as far as it is asked for.
  void add_directions(std::size_t packet, const SkyProfile& profile, const ReceiverPacket& receivers, Answers& answers);
  void trace_hidden(std::size_t packet, const SkyProfile& profile, const ReceiverPacket& receivers);
  /// Sums over the azimuths, for CanopyLoss.
  void add_halves(std::span<const PacketHorizon::Row> terms, std::array<float, SkyHalves::count> CanopyLoss::*of_half,
                  double share, Answers& answers) const;
  /// A bit for each receiver whose interval is too wide.
  [[nodiscard]] std::uint32_t too_wide(const ReceiverPacket& receivers, const Answers& answers) const;
  void count_by_name(const SkyProfile& profile, const ReceiverPacket& receivers, const SkiesOfPacket& skies, std::uint32_t wanted,
                     Answers& answers);
  void trace(const ReceiverPacket& receivers, const SkiesOfPacket& skies, std::uint32_t wanted, Answers& answers);

  const PackageReader& package_;
  const CellReceivers& cell_;
  const FurtherQuantities& further_;
  CanopyCertainty certainty_;
  std::stop_token stop_;
  std::optional<CanopyOnPixels> on_pixels_;
  std::optional<CrownsOfCell> crowns_;  ///< made when first needed
  bool knows_hidden_ = false;           ///< whether marches tell what is hidden
  std::vector<std::uint32_t> marched_;  ///< of each packet: a bit for each receiver that marches answer
  std::vector<CanopyShares> shares_;    ///< of each packet
  std::vector<PacketHorizon::Lanes> behind_sums_, hidden_sums_;
  std::vector<PacketHorizon::Row> behind_, hidden_;            ///< at each azimuth, of all packets: Rows
  std::vector<PacketHorizon::Row> some_behind_, some_hidden_;  ///< of one
  std::vector<DimmedSky> dimmed_;                              ///< of each packet
  std::vector<DimmedSky> some_dimmed_;                         ///< of one
  std::vector<Answers> answers_;
  std::optional<CrownsOfCell> by_name_;  ///< made when first needed, as the next ones, which are for rays
  std::optional<Occluder> near_;
  std::optional<CrownOccluder> occluder_;
  std::uint64_t retraced_rays_ = 0;
};

}  // namespace farlod
