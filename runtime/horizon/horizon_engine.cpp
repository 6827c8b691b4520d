// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <algorithm>
#include <utility>

#include "farlod/expects.hpp"
#include "horizon/gap_rays.hpp"

namespace farlod {
namespace {

PacketHorizon::Lanes sum(std::span<const PacketHorizon::Row> rows) {
  PacketHorizon::Lanes sums{};
  for (const PacketHorizon::Row& row : rows)
    for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += row[l];
  return sums;
}

/// Of a receiver that needs rays, the smallest gaps are not traced, as long as they hold no more of the tolerance than this. They
/// are filled more often than large ones: that so much of them is sky is right on average (docs/decisions/0014).
constexpr float untraced_of_tolerance = 0.5F, sky_in_untraced = 0.25F;

}  // namespace

HorizonEngine::HorizonEngine(const AzimuthRing& ring, SkyWeight weight, const FarHorizon& far, const CellSkyline& skyline,
                             OverhangGeometry& overhangs, const GapSettings& gaps)
    : ring_(ring),
      weight_(weight),
      skyline_(skyline),
      overhangs_(overhangs),
      gaps_(gaps),
      unnamed_(far, ring),
      horizons_(ring),
      near_and_named_(ring) {}

std::uint32_t HorizonEngine::evaluate(const ReceiverPacket& receivers, std::span<BoundedShare> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  const std::uint32_t covered = overhangs_.covered(receivers);
  // What hides much first: what lies below is passed over
  horizons_.grounded.clear();
  unnamed_.raise_likely(receivers, horizons_.grounded);
  horizons_.grounded.raise(skyline_.grounded, receivers);
  if (covered == 0 && skyline_.near.empty() && skyline_.far.empty()) {
    const Lanes sky = horizons_.grounded.sky_above(weight_, receivers);
    for (std::size_t l = 0; l < shares.size(); ++l) shares[l] = {sky[l], sky[l], sky[l]};
    return 0;
  }
  horizons_.upper = horizons_.borders = horizons_.grounded;
  horizons_.draw_overhangs(skyline_, receivers, covered, FarGaps::likely);
  const Lanes sky = horizons_.upper.sky_above(weight_, receivers);
  const BelowBorders below = look_below(receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) {
    const float svf = std::min(sky[l] + below.sky[l], 1.0F);
    shares[l] = {svf, svf, svf};
  }
  return below.by_rays;
}

std::uint32_t HorizonEngine::evaluate_with_bounds(const ReceiverPacket& receivers, std::span<BoundedShare> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  const std::uint32_t covered = overhangs_.covered(receivers);
  // What is certain: the sky above the lowest horizons, and below the borders at the most
  horizons_.grounded.clear();
  horizons_.grounded.raise(skyline_.grounded, receivers);
  near_and_named_ = horizons_.upper = horizons_.borders = horizons_.grounded;
  unnamed_.raise_lower(receivers, horizons_.upper);
  unnamed_.raise_overhang(receivers, horizons_.borders);
  horizons_.draw_overhangs(skyline_, receivers, covered, FarGaps::possible);
  const Lanes highest_below = sum(horizons_.find_sky_below_borders(weight_, receivers, gap_rows_)),
              highest = horizons_.upper.sky_above(weight_, receivers);
  // What is likely: the unnamed is grounded
  std::swap(horizons_.grounded, near_and_named_);
  unnamed_.raise_likely(receivers, horizons_.grounded);
  horizons_.upper = horizons_.borders = horizons_.grounded;
  horizons_.draw_overhangs(skyline_, receivers, covered, FarGaps::likely);
  const Lanes likely = horizons_.upper.sky_above(weight_, receivers);
  const BelowBorders below = look_below(receivers);
  // Above the highest horizons all is open
  unnamed_.raise_upper(receivers, horizons_.upper);
  const Lanes low = horizons_.upper.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) {
    const float high = std::min(highest[l] + highest_below[l], 1.0F);
    shares[l] = {low[l], std::clamp(likely[l] + below.sky[l], low[l], std::max(low[l], high)), high};
  }
  return below.by_rays;
}

HorizonEngine::BelowBorders HorizonEngine::look_below(const ReceiverPacket& receivers) {
  BelowBorders below;
  const Lanes most = sum(horizons_.find_sky_below_borders(weight_, receivers, gap_rows_));
  for (std::size_t l = 0; l < receivers.count; ++l) below.by_rays |= most[l] > gaps_.tolerance ? 1U << l : 0U;
  if (below.by_rays == 0) {
    for (std::size_t l = 0; l < most.size(); ++l) below.sky[l] = 0.5F * most[l];
    return below;
  }
  Lanes untraced{};
  for (std::size_t l = 0; l < receivers.count; ++l)
    if (((below.by_rays >> l) & 1U) != 0) untraced[l] = close_smallest(gap_rows_, l, untraced_of_tolerance * gaps_.tolerance);
  const Lanes seen = trace_gaps({horizons_.grounded, horizons_.borders, horizons_.far_borders, horizons_.far_upper, gap_rows_},
                                ring_, weight_, receivers, below.by_rays, gaps_.rays_per_azimuth, overhangs_.scene());
  for (std::size_t l = 0; l < most.size(); ++l)
    below.sky[l] = ((below.by_rays >> l) & 1U) != 0 ? seen[l] + sky_in_untraced * untraced[l] : 0.5F * most[l];
  return below;
}

}  // namespace farlod
