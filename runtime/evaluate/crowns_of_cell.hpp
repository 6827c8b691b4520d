// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "canopy/canopy_sky.hpp"
#include "canopy/crown_batches.hpp"
#include "farlod/canopy.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "package/crown.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"
#include "scene/canopy_around.hpp"
#include "scene/canopy_levels.hpp"

namespace farlod {

/// CanopySky, where pixels of canopy rasters are merged as a receiver's own place in the plan says: in squares of `place_m`. So
/// what a receiver sees depends on nothing that is in its packet besides. Of one thread.
class CanopyByPlace {
 public:
  static constexpr double place_m = 12.5;

  /// Crowns of the frame of the receivers. The sampling must outlive it.
  CanopyByPlace(const std::vector<Crown>& crowns, const CanopySettings& settings, const AzimuthSampling& azimuths,
                const PixelMerging& merging = {});

  /// As CanopySky::evaluate.
  void evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets, std::span<CanopyShares> shares,
                const CanopyDetails& details);
  /// The same of one packet.
  [[nodiscard]] CanopyShares evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CanopyDetails& details);

 private:
  using Place = std::pair<std::int32_t, std::int32_t>;
  [[nodiscard]] static Place place_of(const ReceiverPacket& receivers, std::size_t lane);
  [[nodiscard]] const CrownBatches& batches_at(const Place& place);

  CanopyLevels levels_;
  PixelMerging merging_;
  bool depends_on_place_;
  CanopySettings settings_;
  CanopySky sky_;
  std::map<Place, CrownBatches> batches_;  ///< made when first needed
  std::vector<PacketHorizon::Row> behind_of_some_;
  std::vector<DimmedSky> dimmed_of_some_;
};

/// The crowns around a cell, those far away merged, and how far that may lead astray. Of one thread.
class CrownsOfCell {
 public:
  /// All but the settings must outlive it.
  CrownsOfCell(const PackageReader& package, const CellReceivers& cell, const CanopySettings& settings,
               const AzimuthSampling& azimuths, const CrownMerging& merging, const PixelMerging& pixel_merging);

  [[nodiscard]] const std::vector<Crown>& crowns() const { return canopy_.crowns; }
  /// Whether no receiver of the cell sees a crown.
  [[nodiscard]] bool are_none() const { return canopy_.crowns.empty() && canopy_.highest_slope_left_out <= 0.0F; }
  /// As CanopySky::evaluate.
  void evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets, std::span<CanopyShares> shares,
                const CanopyDetails& details) {
    by_place_.evaluate(profiles, packets, shares, details);
  }
  /// CanopyShares::lost of these crowns and that of all crowns of the city, one by one, differ by at most so much, above the same
  /// profile, but for what merging pixels does. docs/concepts.md, "Bounds with crowns".
  [[nodiscard]] PacketHorizon::Lanes most_error(const SkyProfile& profile, const ReceiverPacket& receivers);

 private:
  /// The sky below the slope at which crowns may be seen that were left out.
  [[nodiscard]] PacketHorizon::Lanes sky_left_out(const SkyProfile& profile, const ReceiverPacket& receivers);

  const AzimuthSampling& azimuths_;
  BoundedCanopy canopy_;  ///< cell frame
  CanopyByPlace by_place_;
  CrownBatches envelopes_;
  CanopySky sky_;                                        ///< of the envelopes
  std::vector<PacketHorizon::Row> from_, to_, between_;  ///< working memory
};

}  // namespace farlod
