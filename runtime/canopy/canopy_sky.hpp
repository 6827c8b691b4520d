// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "canopy/crown_batches.hpp"
#include "canopy/crown_kernels.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"

namespace farlod {

/// What crowns do to the sky of the receivers of a packet, as shares of a free hemisphere, weighted by the cosine.
struct CanopyShares {
  PacketHorizon::Lanes lost{};    ///< of the sky that is free of solid things, what crowns take away by the rule of the run
  PacketHorizon::Lanes behind{};  ///< the sky that is free of solid things and behind any crown

  /// The sky view factor with canopies, of a receiver whose sky view factor without them is `svf`: in [0, svf].
  [[nodiscard]] float svf_total(std::size_t lane, float svf) const { return std::max(0.0F, svf - std::max(0.0F, lost[lane])); }
  /// 1 − the sky behind crowns, as UMEP defines it.
  [[nodiscard]] float svfveg(std::size_t lane) const { return 1.0F - behind[lane]; }
};

/// The sky behind crowns, by horizons: at each azimuth of a sampling, a crown hides an interval of slopes, and the sky between
/// the ends of intervals is integrated in closed form, or by the rule `beer` by a quadrature. docs/concepts.md, "Crowns".
///   (1) the shares of a receiver depend on its own profile, place and normal, and on the crowns
///   (2) 0 ≤ lost ≤ behind ≤ the sky of the profile, but for rounding
///   (3) a crown more takes no less sky
class CanopySky {
 public:
  /// The sampling must outlive it. Crowns with an axis more than `range_m` away in the plan are not seen.
  explicit CanopySky(const AzimuthSampling& azimuths, float range_m = std::numeric_limits<float>::infinity(),
                     const CrownTarget& kernels = crown_kernels());

  /// Profile, receivers and crowns are of one frame and the azimuths those of the profile. Crowns behind solid things do not
  /// count, since the profile has no sky there. In a gap below an overhang, of whose sky the profile knows the share that is seen
  /// and not where, crowns take the same share of what they would take from all of it.
  [[nodiscard]] CanopyShares evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CrownBatches& crowns) {
    return evaluate(profile, receivers, crowns, {});
  }
  /// The same, and `behind` of each azimuth by itself, unless there are no rows for it: their mean over the azimuths is `behind`,
  /// but for rounding.
  [[nodiscard]] CanopyShares evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CrownBatches& crowns,
                                      std::span<PacketHorizon::Row> behind_of_azimuths);

 private:
  using Lanes = PacketHorizon::Lanes;
  /// Finds the crowns that the packet may see.
  void find_seen(const SkyRows& sky, const CrownScene& scene, const CrownBatches& crowns);
  void sort_from_near_to_far();
  /// Where the list of each azimuth begins, with room for all crowns seen there and one more. Returns the room of all.
  std::size_t begin_lists();
  /// The share of the sky behind those of the crowns in sight that are no more transmissive than this; rows of it, or null.
  [[nodiscard]] Lanes sky_behind(const SkyRows& sky, const CrownScene& scene, float most_transmissivity, float* rows);
  [[nodiscard]] CanopyShares by_smallest(const SkyRows& sky, const CrownScene& scene, const CrownBatches& crowns,
                                         float* behind_of_azimuths);
  [[nodiscard]] CanopyShares by_depth(const SkyRows& sky, const CrownScene& scene, CanopyRule rule, float* behind_of_azimuths);

  const AzimuthSampling& azimuths_;
  float range_square_;
  const CrownTarget& kernels_;
  // Working memory, kept from packet to packet
  std::vector<SeenCrown> seen_, by_distance_, drawn_;
  std::vector<PacketHorizon::Row> ground_, risen_ground_, core_low_, core_high_, low_, high_, ends_;
  std::vector<float> lowest_ground_;
  std::vector<std::uint32_t> begins_, counts_, section_crowns_;
  std::vector<CrownSection> sections_;
};

}  // namespace farlod
