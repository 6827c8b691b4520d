// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/crowns_of_cell.hpp"

#include <algorithm>
#include <limits>

#include "horizon/kernels.hpp"

namespace farlod {
namespace {

float lowest_z(const CellReceivers& cell) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const Receiver& r : cell.receivers) lowest = std::min(lowest, r.p_cell.z);
  return lowest;
}

/// By the rule `once` a crown takes 1 − ψ at the most; by the others, several together may take all.
CanopySettings settings_of_envelopes(const CanopySettings& settings) {
  if (settings.rule == CanopyRule::once) return settings;
  return {CanopyRule::once, Season::leaf_on, 0.0};
}

}  // namespace

CrownsOfCell::CrownsOfCell(const PackageReader& package, const CellReceivers& cell, const CanopySettings& settings,
                           const AzimuthSampling& azimuths, const CrownMerging& merging, const PixelMerging& pixel_merging)
    : azimuths_(azimuths),
      canopy_(bounded_canopy_around(package, cell.cell, lowest_z(cell), merging)),
      by_place_(canopy_.crowns, settings, azimuths, pixel_merging),
      envelopes_(canopy_.envelopes, settings_of_envelopes(settings)),
      sky_(azimuths) {}

PacketHorizon::Lanes CrownsOfCell::most_error(const SkyProfile& profile, const ReceiverPacket& receivers) {
  PacketHorizon::Lanes most = sky_.evaluate(profile, receivers, envelopes_, {}).lost;
  if (canopy_.highest_slope_left_out <= 0.0F) return most;
  const PacketHorizon::Lanes left_out = sky_left_out(profile, receivers);
  for (std::size_t l = 0; l < most.size(); ++l) most[l] += left_out[l];
  return most;
}

PacketHorizon::Lanes CrownsOfCell::sky_left_out(const SkyProfile& profile, const ReceiverPacket& receivers) {
  // Where a horizon jumps, its azimuth stands for up to twice its part of the turn
  constexpr float most_parts = 2.0F;
  const float highest = canopy_.highest_slope_left_out;
  from_.resize(azimuths_.size());
  to_.resize(azimuths_.size());
  between_.resize(azimuths_.size());
  for (std::size_t k = 0; k < azimuths_.size(); ++k)
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
      const float lowest =
          profile.gap_from.empty() ? profile.sky_from[k][l] : std::min(profile.sky_from[k][l], profile.gap_from[k][l]);
      from_[k][l] = std::min(lowest, highest);
      to_[k][l] = highest;
    }
  sky_kernels().find_sky_between(from_.front().data(), to_.front().data(), receivers, azimuths_.view(), false,
                                 between_.front().data());
  PacketHorizon::Lanes sum{};
  for (const PacketHorizon::Row& row : between_)
    for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += most_parts * row[l];
  return sum;
}

}  // namespace farlod
