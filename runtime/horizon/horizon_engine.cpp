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

HorizonEngine::HorizonEngine(const AzimuthRing& ring, SkyWeight weight, const FarHorizon& far, const CellSilhouettes& silhouettes,
                             OverhangGeometry& overhangs, const GapSettings& gaps)
    : ring_(ring),
      weight_(weight),
      silhouettes_(silhouettes),
      overhangs_(overhangs),
      gaps_(gaps),
      residual_(far, ring),
      horizons_(ring),
      near_and_explicit_(ring) {}

std::uint32_t HorizonEngine::evaluate(const ReceiverPacket& receivers, std::span<SvfInterval> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  const std::uint32_t covered = overhangs_.covered(receivers);
  // What hides much first: what lies below is passed over
  horizons_.grounded.clear();
  residual_.raise_to_estimate(receivers, horizons_.grounded);
  horizons_.grounded.raise(silhouettes_.grounded, receivers);
  if (covered == 0 && silhouettes_.near.empty() && silhouettes_.far.empty()) {
    const Lanes sky = horizons_.grounded.sky_above(weight_, receivers);
    for (std::size_t l = 0; l < shares.size(); ++l) shares[l] = {sky[l], sky[l], sky[l]};
    return 0;
  }
  horizons_.upper = horizons_.borders = horizons_.grounded;
  horizons_.draw_overhangs(silhouettes_, receivers, covered, FarGaps::estimate);
  const Lanes sky = horizons_.upper.sky_above(weight_, receivers);
  const BelowBorders below = look_below(receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) {
    const float svf = std::min(sky[l] + below.sky[l], 1.0F);
    shares[l] = {svf, svf, svf};
  }
  return below.by_rays;
}

std::uint32_t HorizonEngine::evaluate_with_bounds(const ReceiverPacket& receivers, std::span<SvfInterval> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  const std::uint32_t covered = overhangs_.covered(receivers);
  // What is certain: the sky above the lowest horizons, and below the borders at the most
  horizons_.grounded.clear();
  horizons_.grounded.raise(silhouettes_.grounded, receivers);
  near_and_explicit_ = horizons_.upper = horizons_.borders = horizons_.grounded;
  residual_.raise_to_low(receivers, horizons_.upper);
  residual_.raise_to_overhang(receivers, horizons_.borders);
  horizons_.draw_overhangs(silhouettes_, receivers, covered, FarGaps::possible);
  const Lanes highest_below = sum(horizons_.find_sky_below_borders(weight_, receivers, gap_rows_)),
              highest = horizons_.upper.sky_above(weight_, receivers);
  // The estimate: the residual city is grounded
  std::swap(horizons_.grounded, near_and_explicit_);
  residual_.raise_to_estimate(receivers, horizons_.grounded);
  horizons_.upper = horizons_.borders = horizons_.grounded;
  horizons_.draw_overhangs(silhouettes_, receivers, covered, FarGaps::estimate);
  const Lanes estimate = horizons_.upper.sky_above(weight_, receivers);
  const BelowBorders below = look_below(receivers);
  // Above the highest horizons all is open
  residual_.raise_to_high(receivers, horizons_.upper);
  const Lanes low = horizons_.upper.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) {
    const float high = std::min(highest[l] + highest_below[l], 1.0F);
    shares[l] = {low[l], std::clamp(estimate[l] + below.sky[l], low[l], std::max(low[l], high)), high};
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
