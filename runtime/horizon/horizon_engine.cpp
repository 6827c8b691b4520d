// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contract/cancellation.hpp"
#include "contract/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// Of a receiver that needs rays, the smallest gaps are not traced, as long as they hold no more of the tolerance than this. They
/// are filled more often than large ones: a quarter of them is sky on average (docs/decisions/0014).
constexpr float untraced_of_tolerance = 0.5F, sky_in_untraced = 0.25F;

Lanes sum(std::span<const PacketHorizon::Row> rows) {
  Lanes sums{};
  for (const PacketHorizon::Row& row : rows)
    for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += row[l];
  return sums;
}

bool has_bit(std::uint32_t bits, std::size_t lane) { return ((bits >> lane) & 1U) != 0; }

/// Offsets of the rays of neighboring azimuths within their parts of a gap: fractional parts of the multiples of the golden
/// ratio, which spread evenly.
float offset_of(std::size_t azimuth) {
  constexpr double golden = 0.61803398874989485;
  const double multiple = golden * static_cast<double>(azimuth);
  return static_cast<float>(multiple - std::floor(multiple));
}

/// A bit for each receiver whose slope lies between the two `filled` horizons.
std::uint32_t in_filled(const Gaps& gaps, std::size_t azimuth, const Lanes& slopes) {
  const PacketHorizon::Row &from = gaps.filled_from.row(azimuth), &to = gaps.filled_to.row(azimuth);
  std::uint32_t bits = 0;
  for (std::size_t l = 0; l < slopes.size(); ++l) bits |= slopes[l] >= from[l] && slopes[l] < to[l] ? 1U << l : 0U;
  return bits;
}

/// The receivers with a gap at one azimuth, and the largest of the gaps.
struct OpenLanes {
  std::uint32_t bits = 0;
  float max_sky = 0.0F;
};
OpenLanes open_lanes(const PacketHorizon::Row& sky, std::uint32_t wanted) {
  OpenLanes open;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) {
    if (sky[l] <= 0.0F || !has_bit(wanted, l)) continue;
    open.bits |= 1U << l;
    open.max_sky = std::max(open.max_sky, sky[l]);
  }
  return open;
}

std::size_t ray_count(float share_of_azimuth, std::size_t rays_per_azimuth) {
  const float wanted = std::ceil(share_of_azimuth * static_cast<float>(rays_per_azimuth));
  return static_cast<std::size_t>(std::max(1.0F, wanted));
}

}  // namespace

HorizonEngine::HorizonEngine(const AzimuthSampling& azimuths, SkyWeight weight, const FarHorizon& far,
                             const CellSilhouettes& silhouettes, OverhangGeometry& overhangs, const GapSettings& gaps,
                             JumpPlaces jumps)
    : azimuths_(azimuths),
      weight_(weight),
      silhouettes_(silhouettes),
      overhangs_(overhangs),
      gaps_(gaps),
      jump_places_(jumps),
      residual_(far, azimuths),
      group_(azimuths),
      jumps_(azimuths),
      horizons_(azimuths, PacketHorizon::Edges::tracked),
      without_residual_(azimuths, PacketHorizon::Edges::tracked) {}

template <class Begin>
void HorizonEngine::draw_grounded(std::span<const ReceiverPacket> packets, const Begin& begin) {
  while (grounded_.size() < packets.size()) grounded_.emplace_back(azimuths_, PacketHorizon::Edges::tracked);
  const std::span horizons = std::span(grounded_).first(packets.size());
  for (std::size_t n = 0; n < packets.size(); ++n) {
    horizons[n].clear();
    begin(packets[n], horizons[n]);
  }
  group_.raise(silhouettes_.grounded, packets, horizons);
  // What the grounded horizons hide is neither above an upper border nor in a gap
  const auto keep = [&](const OverhangEdges& all, OverhangEdges& in_sight) {
    group_.keep_raising(all.overhangs, packets, horizons, in_sight.overhangs);
    group_.keep_raising(all.undersides, packets, horizons, in_sight.undersides);
  };
  keep(silhouettes_.near, in_sight_.near);
  keep(silhouettes_.far, in_sight_.far);
}

void HorizonEngine::evaluate(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers) {
  FARLOD_EXPECTS(answers.size() == packets.size());
  // The residual horizon comes first: it is cheap, and culls edges
  draw_grounded(packets,
                [this](const ReceiverPacket& packet, PacketHorizon& horizon) { residual_.raise_to_estimate(packet, horizon); });
  for (std::size_t n = 0; n < packets.size(); ++n) {
    std::swap(horizons_.grounded, grounded_[n]);
    evaluate(packets[n], answers[n]);
  }
}

void HorizonEngine::evaluate_with_bounds(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers) {
  FARLOD_EXPECTS(answers.size() == packets.size());
  draw_grounded(packets, [](const ReceiverPacket&, PacketHorizon&) {});
  for (std::size_t n = 0; n < packets.size(); ++n) {
    std::swap(horizons_.grounded, grounded_[n]);
    evaluate_with_bounds(packets[n], answers[n]);
  }
}

void HorizonEngine::evaluate(const ReceiverPacket& receivers, PacketAnswer& answer) {
  const std::uint32_t below = overhangs_.receivers_below(receivers);
  // Without overhangs in sight, the sky above it is the answer
  if (below == 0 && in_sight_.empty()) {
    const Lanes sky = sky_above(horizons_.grounded, receivers).sky;
    for (std::size_t l = 0; l < sky.size(); ++l) answer.svf[l] = {sky[l], sky[l], sky[l]};
    answer.by_rays = 0;
    return;
  }
  // Else it is the sky above the upper borders, plus what is seen in the gaps below the lower borders
  horizons_.upper_borders = horizons_.grounded;
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  horizons_.draw_overhangs(in_sight_, receivers, below, FarGapEnd::lowest);
  const Lanes sky = sky_above(horizons_.upper_borders, receivers).sky;
  const SkyInGaps gaps = sky_in_gaps(receivers);
  for (std::size_t l = 0; l < sky.size(); ++l) {
    const float sum = std::min(sky[l] + gaps.sky[l], 1.0F);
    answer.svf[l] = {sum, sum, sum};
  }
  answer.by_rays = gaps.by_rays;
}

void HorizonEngine::evaluate_with_bounds(const ReceiverPacket& receivers, PacketAnswer& answer) {
  const std::uint32_t below = overhangs_.receivers_below(receivers);
  // The high SVF: sky above the residual's low bound, and all of the gaps, up to the highest borders
  without_residual_ = horizons_.grounded;
  horizons_.upper_borders.set_slopes(horizons_.grounded);
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  residual_.raise_to_low(receivers, horizons_.upper_borders);
  residual_.raise_to_overhang(receivers, horizons_.lower_borders);
  horizons_.draw_overhangs(in_sight_, receivers, below, FarGapEnd::highest);
  const Lanes most_in_gaps = sum(horizons_.find_sky_in_gaps(weight_, receivers, gap_rows_)),
              most_above = horizons_.upper_borders.sky_above(weight_, receivers);
  // The estimate, as in evaluate(): the residual city is grounded
  std::swap(horizons_.grounded, without_residual_);
  residual_.raise_to_estimate(receivers, horizons_.grounded);
  horizons_.upper_borders = horizons_.grounded;
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  horizons_.draw_overhangs(in_sight_, receivers, below, FarGapEnd::lowest);
  const HorizonJumps::SkyAbove estimate = sky_above(horizons_.upper_borders, receivers);
  const SkyInGaps gaps = sky_in_gaps(receivers);
  // The low SVF: sky above the residual's high bound, and nothing of the gaps
  residual_.raise_to_high(receivers, horizons_.upper_borders);
  const Lanes low = horizons_.upper_borders.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < low.size(); ++l) {
    // Both are rounded: where the interval has no width, the sums may differ in their last bit
    const float even_high = std::max(low[l], std::min(most_above[l] + most_in_gaps[l], 1.0F));
    // Jumps are placed where they are for the bounds, too
    const auto placed = [&](float svf) { return std::clamp(svf + estimate.correction[l], 0.0F, 1.0F); };
    const float lowest = placed(low[l]), highest = placed(even_high);
    answer.svf[l] = {lowest, std::clamp(estimate.sky[l] + gaps.sky[l], lowest, highest), highest};
  }
  answer.by_rays = gaps.by_rays;
}

HorizonJumps::SkyAbove HorizonEngine::sky_above(const PacketHorizon& horizon, const ReceiverPacket& receivers) {
  if (jump_places_ == JumpPlaces::between_azimuths) return {horizon.sky_above(weight_, receivers), {}};
  return jumps_.sky_above(horizon, weight_, receivers, silhouettes_.upper_ends);
}

HorizonEngine::SkyInGaps HorizonEngine::sky_in_gaps(const ReceiverPacket& receivers) {
  SkyInGaps gaps;
  // Receivers with little sky in gaps: half of it counts
  const Lanes most = sum(horizons_.find_sky_in_gaps(weight_, receivers, gap_rows_));
  for (std::size_t l = 0; l < receivers.count; ++l) gaps.by_rays |= most[l] > gaps_.tolerance ? 1U << l : 0U;
  for (std::size_t l = 0; l < most.size(); ++l) gaps.sky[l] = 0.5F * most[l];
  if (gaps.by_rays == 0) return gaps;
  // The others: trace all gaps but the smallest
  Lanes untraced{};
  for (std::size_t l = 0; l < receivers.count; ++l)
    if (has_bit(gaps.by_rays, l)) untraced[l] = remove_smallest_gaps(gap_rows_, l, untraced_of_tolerance * gaps_.tolerance);
  const Lanes seen = trace_gaps(
      {horizons_.grounded, horizons_.lower_borders, horizons_.far_lower_borders, horizons_.far_upper_borders, gap_rows_},
      azimuths_, weight_, receivers, gaps.by_rays, gaps_.rays_per_azimuth, overhangs_.scene(), gaps_.stop);
  for (std::size_t l = 0; l < most.size(); ++l)
    if (has_bit(gaps.by_rays, l)) gaps.sky[l] = seen[l] + sky_in_untraced * untraced[l];
  return gaps;
}

float remove_smallest_gaps(std::span<PacketHorizon::Row> sky, std::size_t lane, float max_sky) {
  // The size of the largest gap that can be removed
  std::vector<float> sizes;
  for (const PacketHorizon::Row& row : sky)
    if (row[lane] > 0.0F) sizes.push_back(row[lane]);
  std::sort(sizes.begin(), sizes.end());
  float total = 0.0F, largest = 0.0F;
  for (const float size : sizes) {
    if (total + size > max_sky) break;
    total += size;
    largest = size;
  }
  // Remove the gaps up to that size. Of several of that size, the last may be too many
  float removed = 0.0F;
  for (PacketHorizon::Row& row : sky)
    if (row[lane] <= largest && removed + row[lane] <= max_sky) removed += std::exchange(row[lane], 0.0F);
  return removed;
}

Lanes trace_gaps(const Gaps& gaps, const AzimuthSampling& azimuths, SkyWeight weight, const ReceiverPacket& receivers,
                 std::uint32_t wanted, std::size_t rays_per_azimuth, const PlacedScene& scene, const std::stop_token& stop) {
  const SkyKernels& kernels = sky_kernels();
  const RayOrigins origins = scene.origins_of(receivers);
  Lanes seen{};
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    const OpenLanes open = open_lanes(gaps.sky[k], wanted);
    if (open.bits == 0) continue;
    // Divide each receiver's gap into parts of equal sky, with a ray in each: all rays of a receiver count alike
    const std::size_t count = ray_count(open.max_sky * static_cast<float>(azimuths.size()), rays_per_azimuth);
    const GapAzimuth azimuth{azimuths.cosine()[k], azimuths.sine()[k], weight == SkyWeight::solid_angle};
    GapEnds ends;
    kernels.find_gap_ends(gaps.from.row(k).data(), gaps.to.row(k).data(), receivers, azimuth, ends);
    Lanes free_rays{};
    for (std::size_t n = 0; n < count; ++n) {
      if (n % directions_between_looks == 0) throw_if_cancelled(stop);
      Occluder::Directions directions;
      directions.x.fill(azimuth.cosine);
      directions.y.fill(azimuth.sine);
      kernels.find_gap_slopes(ends, receivers, azimuth, (static_cast<float>(n) + offset_of(k)) / static_cast<float>(count),
                              directions.z.data());
      const std::uint32_t asked = open.bits & ~in_filled(gaps, k, directions.z);
      const std::uint32_t free = asked & ~scene.occluder.blocked(origins, directions, least_distance_m, asked);
      for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l) free_rays[l] += has_bit(free, l) ? 1.0F : 0.0F;
    }
    // (sky of the gap) · (free rays / rays), as a share of the turn
    const float ray_share = 1.0F / static_cast<float>(count * azimuths.size());
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      seen[l] += free_rays[l] * (ends.sky_from[l] - ends.sky_to[l]) * ray_share;
  }
  return seen;
}

}  // namespace farlod
