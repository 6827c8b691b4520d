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
#include "canopy/dimmed_sky.hpp"
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

/// What is wanted of packets besides their shares, or nothing.
struct CanopyDetails {
  /// Take `behind` of each azimuth by itself, packet by packet: the mean over the azimuths is `behind`, but for rounding.
  std::span<PacketHorizon::Row> behind_of_azimuths = {};
  std::span<DimmedSky> dimmed = {};  ///< of each packet: `lost` by slopes, with shares lost as the rule of the run has them
  /// Those of one packet of so many.
  [[nodiscard]] CanopyDetails of_packet(std::size_t n, std::size_t packets) const {
    const std::size_t azimuths = behind_of_azimuths.size() / packets;
    return {behind_of_azimuths.subspan(n * azimuths, azimuths), dimmed.empty() ? dimmed : dimmed.subspan(n, 1)};
  }
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

  /// Evaluates packets near each other, for which most crowns are culled at once. Profiles, receivers and crowns are of one
  /// frame, and the azimuths those of the profiles. Crowns behind solid things do not count, since a profile has no sky there. In
  /// a gap below an overhang, of whose sky the profile knows the share that is seen and not where, crowns take the same share of
  /// what they would take from all of it.
  void evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets, const CrownBatches& crowns,
                std::span<CanopyShares> shares, const CanopyDetails& details = {});
  /// The same of one packet.
  [[nodiscard]] CanopyShares evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CrownBatches& crowns,
                                      const CanopyDetails& details = {});

 private:
  using Lanes = PacketHorizon::Lanes;
  [[nodiscard]] CrownScene scene_of(const ReceiverPacket& receivers, const CrownBatches& crowns) const;
  void find_lowest_grounds(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets);
  /// The crowns that some of the packets may see.
  void find_in_sight(std::span<const ReceiverPacket> packets, const CrownBatches& crowns);
  /// The crowns of a scene that may be seen from the box, above the lowest ground of some packet.
  void find_seen(const CrownScene& scene, const CenteredBox& box, std::span<const float* const> lowest);
  void sort_from_near_to_far();
  /// Evaluates one packet, whose lowest ground at each azimuth is `lowest`.
  [[nodiscard]] CanopyShares evaluate(const SkyRows& sky, const ReceiverPacket& receivers, const float* lowest,
                                      const CanopyDetails& details);
  /// Where the list of each azimuth begins, with room for all crowns to be drawn there. Returns the room of all.
  std::size_t begin_lists();
  /// The share of the sky behind those of the crowns seen that are no more transmissive than this.
  [[nodiscard]] Lanes sky_behind(const SkyRows& sky, const CrownScene& scene, const float* lowest, float most_transmissivity,
                                 const BehindRows& wanted);
  [[nodiscard]] CanopyShares by_smallest(const SkyRows& sky, const CrownScene& scene, const float* lowest,
                                         const CanopyDetails& details);
  [[nodiscard]] CanopyShares by_depth(const SkyRows& sky, const CrownScene& scene, const float* lowest,
                                      const CanopyDetails& details);

  const AzimuthSampling& azimuths_;
  float range_square_;
  const CrownTarget& kernels_;
  // Working memory, kept from group to group
  std::vector<std::vector<float>> lowest_grounds_;  ///< of each packet, at each azimuth
  CrownBatches in_sight_;
  std::vector<SeenCrown> seen_, drawn_;
  std::vector<PlacedCrown> placed_;
  std::vector<std::uint32_t> numbers_, begins_, ends_, counts_, listed_;
  std::vector<CrownSection> sections_;
  std::vector<PacketHorizon::Row> room_;
};

}  // namespace farlod
