// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <algorithm>

#include "farlod/expects.hpp"
#include "horizon/gap_rays.hpp"

namespace farlod {

HorizonEngine::HorizonEngine(const AzimuthRing& ring, SkyWeight weight, const FarHorizon& far, const CellSkyline& skyline,
                             OverhangGeometry& overhangs, const GapSettings& gaps)
    : ring_(ring),
      weight_(weight),
      skyline_(skyline),
      overhangs_(overhangs),
      gaps_(gaps),
      unnamed_(far, ring),
      grounded_(ring),
      upper_(ring),
      borders_(ring) {}

std::uint32_t HorizonEngine::evaluate(const ReceiverPacket& receivers, std::span<BoundedShare> shares) {
  FARLOD_EXPECTS(shares.size() == receivers.count);
  const std::uint32_t covered = overhangs_.covered(receivers);
  // What hides much first: what lies below is passed over
  grounded_.clear();
  unnamed_.raise_likely(receivers, grounded_);
  grounded_.raise(skyline_.grounded, receivers);
  if (covered == 0 && skyline_.overhangs.empty()) {
    const Lanes sky = grounded_.sky_above(weight_, receivers);
    for (std::size_t l = 0; l < shares.size(); ++l) shares[l] = {sky[l], sky[l], sky[l]};
    return 0;
  }
  upper_ = grounded_;
  upper_.raise(skyline_.overhangs, receivers);
  upper_.close(covered);
  const Lanes sky = upper_.sky_above(weight_, receivers);
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
  // What is certain: sky below the borders at the most, and above the lowest horizons
  grounded_.clear();
  grounded_.raise(skyline_.grounded, receivers);
  upper_ = grounded_;
  unnamed_.raise_lower(receivers, upper_);
  upper_.raise(skyline_.overhangs, receivers);
  upper_.close(covered);
  borders_ = grounded_;
  borders_.raise(skyline_.undersides, receivers);
  unnamed_.raise_overhang(receivers, borders_);
  const Lanes highest_below = sky_below_borders(receivers), highest = upper_.sky_above(weight_, receivers);
  // What is likely
  unnamed_.raise_likely(receivers, grounded_);
  unnamed_.raise_likely(receivers, upper_);
  const Lanes likely = upper_.sky_above(weight_, receivers);
  const BelowBorders below = look_below(receivers);
  // Above the highest horizons all is open
  unnamed_.raise_upper(receivers, upper_);
  const Lanes low = upper_.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < shares.size(); ++l) {
    const float high = std::min(highest[l] + highest_below[l], 1.0F);
    shares[l] = {low[l], std::clamp(likely[l] + below.sky[l], low[l], std::max(low[l], high)), high};
  }
  return below.by_rays;
}

HorizonEngine::Lanes HorizonEngine::sky_below_borders(const ReceiverPacket& receivers) {
  Lanes sum{};
  if (borders_.above(grounded_) == 0) return sum;
  // Above the highest border and below the upper horizon, nothing is open
  borders_.lower_to(upper_);
  grounded_.find_sky_below(borders_, weight_, receivers, gap_rows_);
  for (const PacketHorizon::Row& row : gap_rows_)
    for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += row[l];
  return sum;
}

HorizonEngine::BelowBorders HorizonEngine::look_below(const ReceiverPacket& receivers) {
  BelowBorders below;
  if (skyline_.undersides.empty()) return below;
  borders_ = grounded_;
  borders_.raise(skyline_.undersides, receivers);
  const Lanes most = sky_below_borders(receivers);
  for (std::size_t l = 0; l < receivers.count; ++l) below.by_rays |= most[l] > gaps_.tolerance ? 1U << l : 0U;
  Lanes seen{};
  if (below.by_rays != 0)
    seen = trace_gaps({grounded_, borders_, gap_rows_}, ring_, weight_, receivers, below.by_rays, gaps_.rays_per_azimuth,
                      overhangs_.scene());
  for (std::size_t l = 0; l < most.size(); ++l)
    below.sky[l] = ((below.by_rays >> l) & 1U) != 0 ? seen[l] : 0.5F * most[l];
  return below;
}

}  // namespace farlod
