// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "contract/canopy/crown.hpp"
#include "evaluate/canopy_by_place.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/sky_halves.hpp"
#include "evaluate/traced_canopy.hpp"
#include "farlod/quantities.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The values of a receiver whose sky view factor is known, in the order of columns_of: as many as count_canopy_columns says.
void write_canopy_columns(const Quantities& quantities, float svf, const CanopyLoss& loss, std::span<float> values);

/// Stores what canopies do, of receivers whose svf is stored, by rays in their directions. Added to a place of the cell's frame,
/// `scene_from_cell_m` gives one of the scene's. Throws Cancelled when `stop` is asked for.
void store_traced_canopies(const CellReceivers& cell, const CanopyScene& scene, Point2d scene_from_cell_m,
                           const SkyDirections& directions, const FurtherQuantities& quantities, const SkyAnswers& answers,
                           const std::stop_token& stop);

/// What the crowns around a cell take of the view of its receivers, by profiles of the sky. Of one thread.
class CanopyAnswers {
 public:
  using Losses = std::array<CanopyLoss, ReceiverPacket::lanes>;

  /// All must outlive it.
  CanopyAnswers(const PackageReader& package, const CellReceivers& cell, const FurtherQuantities& further);

  /// Of the receivers of a packet. CanopyLoss::building, which takes rays, is that of a quantity that needs it, or 0.
  [[nodiscard]] Losses evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const std::stop_token& stop);

 private:
  const PackageReader& package_;
  const CellReceivers& cell_;
  /// Sums over the azimuths, of what is behind crowns, for CanopyLoss.
  void add_halves(std::span<const PacketHorizon::Row> terms, std::array<float, SkyHalves::count> CanopyLoss::*of_half,
                  double share, Losses& losses) const;

  const FurtherQuantities& further_;
  std::vector<Crown> crowns_;                        ///< cell frame
  CanopyByPlace sky_;                                ///< the same for horizons
  std::vector<PacketHorizon::Row> behind_, hidden_;  ///< at each azimuth: sky and what is solid, behind crowns
  std::optional<Occluder> near_;                     ///< for rays, as the next one; made when first needed
  std::optional<CrownOccluder> occluder_;
};

}  // namespace farlod
