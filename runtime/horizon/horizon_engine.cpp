// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <algorithm>
#include <cmath>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// The smallest gaps of a receiver that needs rays are not traced, as long as they hold no more of the tolerance than this. They
/// are filled more often than large ones: a quarter of them is sky on average (docs/decisions/0014).
constexpr float untraced_of_tolerance = 0.5F, sky_in_untraced = 0.25F;

/// The rounding of two sums over the azimuths.
constexpr double rounding_of_width = 1e-6;

Lanes sum(std::span<const PacketHorizon::Row> rows) {
  Lanes sums{};
  for (const PacketHorizon::Row& row : rows)
    for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += row[l];
  return sums;
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
      without_residual_(azimuths, PacketHorizon::Edges::tracked),
      undecided_(azimuths) {}

void HorizonEngine::tell_profiles(ProfileRows rows, OnProfile on_profile) {
  FARLOD_EXPECTS(weight_ == SkyWeight::cosine && jump_places_ == JumpPlaces::at_edge_ends);
  profile_rows_ = rows;
  on_profile_ = std::move(on_profile);
  profile_.emplace(azimuths_);
}

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
    if (profile_) on_profile_(n, *profile_);
  }
}

void HorizonEngine::evaluate_with_bounds(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers) {
  FARLOD_EXPECTS(answers.size() == packets.size());
  draw_grounded(packets, [](const ReceiverPacket&, PacketHorizon&) {});
  for (std::size_t n = 0; n < packets.size(); ++n) {
    std::swap(horizons_.grounded, grounded_[n]);
    evaluate_with_bounds(packets[n], answers[n]);
    if (profile_) on_profile_(n, *profile_);
  }
}

void HorizonEngine::evaluate(const ReceiverPacket& receivers, PacketAnswer& answer) {
  const std::uint32_t below = overhangs_.receivers_below(receivers);
  // Without overhangs in sight, the sky above it is the answer
  if (below == 0 && in_sight_.empty()) {
    const Lanes sky = sky_above(horizons_.grounded, receivers).sky;
    for (std::size_t l = 0; l < sky.size(); ++l) answer.svf[l] = answer.drawn[l] = {sky[l], sky[l], sky[l]};
    answer.by_rays = answer.by_gap_rays = 0;
    answer.retraced_rays = 0;
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
    answer.svf[l] = answer.drawn[l] = {sum, sum, sum};
  }
  answer.by_rays = answer.by_gap_rays = gaps.by_rays;
  answer.retraced_rays = 0;
}

void HorizonEngine::evaluate_with_bounds(const ReceiverPacket& receivers, PacketAnswer& answer) {
  const std::uint32_t below = overhangs_.receivers_below(receivers);
  const bool has_overhangs = below != 0 || !in_sight_.empty() || !residual_.is_grounded();
  BoundedSky sky = has_overhangs ? bounded_with_overhangs(receivers, below) : bounded_without_overhangs(receivers);
  for (std::size_t l = 0; l < sky.low.size(); ++l) answer.drawn[l] = sky.interval(l);
  const Retraced retraced = allowed_ ? retrace(receivers, has_overhangs, sky) : Retraced{sky.gaps.by_rays, 0};
  const float allowed = allowed_ ? static_cast<float>(allowed_->error) : 1.0F;
  for (std::size_t l = 0; l < sky.low.size(); ++l) answer.svf[l] = within_error(sky.interval(l), allowed);
  answer.by_rays = retraced.receivers;
  answer.by_gap_rays = sky.gaps.by_rays;
  answer.retraced_rays = retraced.rays;
}

SvfInterval HorizonEngine::BoundedSky::interval(std::size_t lane) const {
  // Both are rounded: where the interval has no width, the sums may differ in their last bit
  const float even_high = std::max(low[lane], std::min(high[lane], 1.0F));
  // Jumps are placed where they are for the bounds, too
  const auto placed = [&](float svf) { return std::clamp(svf + estimate.correction[lane], 0.0F, 1.0F); };
  const float lowest = placed(low[lane]), highest = placed(even_high);
  return {lowest, std::clamp(estimate.sky[lane] + gaps.sky[lane], lowest, highest), highest};
}

HorizonEngine::BoundedSky HorizonEngine::bounded_without_overhangs(const ReceiverPacket& receivers) {
  BoundedSky sky;
  undecided_.from.set_slopes(horizons_.grounded);
  residual_.raise_to_low(receivers, undecided_.from);
  sky.high = undecided_.from.sky_above(weight_, receivers);
  residual_.raise_to_estimate(receivers, horizons_.grounded);
  sky.estimate = sky_above(horizons_.grounded, receivers);
  undecided_.to.set_slopes(horizons_.grounded);
  residual_.raise_to_high(receivers, undecided_.to);
  sky.low = undecided_.to.sky_above(weight_, receivers);
  return sky;
}

HorizonEngine::BoundedSky HorizonEngine::bounded_with_overhangs(const ReceiverPacket& receivers, std::uint32_t below) {
  BoundedSky sky;
  // The high SVF: sky above the residual's low bound, and all of the gaps, up to the highest borders
  without_residual_ = horizons_.grounded;
  horizons_.upper_borders.set_slopes(horizons_.grounded);
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  residual_.raise_to_low(receivers, horizons_.upper_borders);
  residual_.raise_to_overhang(receivers, horizons_.lower_borders);
  horizons_.draw_overhangs(in_sight_, receivers, below, FarGapEnd::highest);
  most_sky_of_gaps_ = horizons_.find_sky_in_gaps(weight_, receivers, most_gap_rows_);
  const Lanes most_in_gaps = sum(most_sky_of_gaps_), most_above = horizons_.upper_borders.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < sky.high.size(); ++l) sky.high[l] = most_above[l] + most_in_gaps[l];
  if (allowed_) undecided_.from.set_slopes(horizons_.upper_borders);
  // The estimate, as in evaluate(): the residual city is grounded
  std::swap(horizons_.grounded, without_residual_);
  residual_.raise_to_estimate(receivers, horizons_.grounded);
  horizons_.upper_borders = horizons_.grounded;
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  horizons_.draw_overhangs(in_sight_, receivers, below, FarGapEnd::lowest);
  sky.estimate = sky_above(horizons_.upper_borders, receivers);
  sky.gaps = sky_in_gaps(receivers);
  // The low SVF: sky above the residual's high bound, and nothing of the gaps
  undecided_.to.set_slopes(horizons_.upper_borders);
  residual_.raise_to_high(receivers, undecided_.to);
  sky.low = undecided_.to.sky_above(weight_, receivers);
  return sky;
}

HorizonEngine::Retraced HorizonEngine::retrace(const ReceiverPacket& receivers, bool has_overhangs, BoundedSky& sky) {
  // Less than what rounding leaves of it
  const double max_width = std::max(0.0, 2.0 * allowed_->error - rounding_of_width);
  UndecidedSky::Wanted wanted{0, max_width, gaps_.rays_per_azimuth, gaps_.stop};
  for (std::size_t l = 0; l < receivers.count; ++l)
    wanted.receivers |= static_cast<double>(sky.high[l]) - static_cast<double>(sky.low[l]) > max_width ? 1U << l : 0U;
  if (wanted.receivers == 0) return {};
  undecided_.measure(has_overhangs ? horizons_.upper_borders : horizons_.grounded, weight_, receivers);
  if (has_overhangs) {
    if (!residual_.is_grounded()) {
      horizons_.far_lower_borders.clear();
      residual_.raise_to_overhang(receivers, horizons_.far_lower_borders);
      undecided_.mark_gaps(horizons_.far_lower_borders);
    }
    undecided_.add_gaps(most_sky_of_gaps_, sky_of_gaps_, without_residual_);
  }
  const UndecidedSky::Decided decided = undecided_.decide(wanted, allowed_->city.seen_from(allowed_->cell), weight_, receivers);
  for (std::size_t l = 0; l < receivers.count; ++l) {
    if (!has_bit(wanted.receivers, l)) continue;
    const double low = static_cast<double>(sky.low[l]) + decided.seen[l];
    sky.low[l] = static_cast<float>(low);
    sky.high[l] = static_cast<float>(low + decided.width[l]);
    sky.estimate.sky[l] = static_cast<float>(low + decided.expected[l]) + sky.estimate.correction[l];
    sky.gaps.sky[l] = 0.0F;
  }
  return {wanted.receivers, decided.rays};
}

HorizonJumps::SkyAbove HorizonEngine::sky_above(const PacketHorizon& horizon, const ReceiverPacket& receivers) {
  if (jump_places_ == JumpPlaces::between_azimuths) return {horizon.sky_above(weight_, receivers), {}};
  if (!profile_) return jumps_.sky_above(horizon, weight_, receivers, silhouettes_.upper_ends);
  profile_above(horizon, receivers);
  return jumps_.sky_above(horizon, weight_, receivers, silhouettes_.upper_ends, profile_->sky);
}

void HorizonEngine::profile_above(const PacketHorizon& horizon, const ReceiverPacket& receivers) {
  for (std::size_t k = 0; k < azimuths_.size(); ++k) profile_->sky_from[k] = horizon.row(k);
  profile_->gap_from.clear();
  profile_->gap_to.clear();
  profile_->gap_share.clear();
  profile_->sky.resize(azimuths_.size());
  if (profile_rows_ == ProfileRows::sky) return;
  profile_->solid_sky.resize(azimuths_.size());
  (void)jumps_.sky_above(horizon, SkyWeight::solid_angle, receivers, silhouettes_.upper_ends, profile_->solid_sky);
}

void HorizonEngine::profile_gaps(const ReceiverPacket& receivers) {
  // The share of all between the borders, of which the far occluders are a part
  horizons_.grounded.find_sky_below(horizons_.lower_borders, weight_, receivers, all_gap_rows_);
  for (std::size_t k = 0; k < azimuths_.size(); ++k) {
    profile_->gap_from.push_back(horizons_.grounded.row(k));
    profile_->gap_to.push_back(horizons_.lower_borders.row(k));
    PacketHorizon::Row& share = profile_->gap_share.emplace_back();
    for (std::size_t l = 0; l < share.size(); ++l)
      if (all_gap_rows_[k][l] > 0.0F) share[l] = std::min(seen_rows_[k][l] / all_gap_rows_[k][l], 1.0F);
  }
}

HorizonEngine::SkyInGaps HorizonEngine::sky_in_gaps(const ReceiverPacket& receivers) {
  SkyInGaps gaps;
  // Receivers with little sky in gaps: half of it counts
  sky_of_gaps_ = horizons_.find_sky_in_gaps(weight_, receivers, gap_rows_);
  const Lanes most = sum(sky_of_gaps_);
  for (std::size_t l = 0; l < receivers.count; ++l) gaps.by_rays |= most[l] > gaps_.tolerance ? 1U << l : 0U;
  for (std::size_t l = 0; l < most.size(); ++l) gaps.sky[l] = 0.5F * most[l];
  if (profile_) {
    seen_rows_.assign(sky_of_gaps_.begin(), sky_of_gaps_.end());
    for (PacketHorizon::Row& row : seen_rows_)
      for (float& sky : row) sky *= 0.5F;
  }
  // The others: rays decide
  if (gaps.by_rays != 0 && !allowed_) trace_sky_in_gaps(receivers, gaps);
  if (profile_ && !sky_of_gaps_.empty()) profile_gaps(receivers);
  return gaps;
}

void HorizonEngine::trace_sky_in_gaps(const ReceiverPacket& receivers, SkyInGaps& gaps) {
  // Trace all gaps but the smallest
  Lanes untraced{};
  const std::vector<PacketHorizon::Row> before = profile_ ? gap_rows_ : std::vector<PacketHorizon::Row>();
  for (std::size_t l = 0; l < receivers.count; ++l)
    if (has_bit(gaps.by_rays, l)) untraced[l] = remove_smallest_gaps(gap_rows_, l, untraced_of_tolerance * gaps_.tolerance);
  for (std::size_t k = 0; k < before.size(); ++k)
    for (std::size_t l = 0; l < before[k].size(); ++l)
      if (has_bit(gaps.by_rays, l)) seen_rows_[k][l] = gap_rows_[k][l] > 0.0F ? 0.0F : sky_in_untraced * before[k][l];
  const Gaps traced{horizons_.grounded, horizons_.lower_borders, horizons_.far_lower_borders, horizons_.far_upper_borders,
                    gap_rows_};
  const Lanes seen = trace_gaps(traced, azimuths_, weight_, receivers, gaps.by_rays, gaps_.rays_per_azimuth, overhangs_.scene(),
                                gaps_.stop, profile_ ? std::span(seen_rows_) : std::span<PacketHorizon::Row>())
                         .sky;
  for (std::size_t l = 0; l < seen.size(); ++l)
    if (has_bit(gaps.by_rays, l)) gaps.sky[l] = seen[l] + sky_in_untraced * untraced[l];
}

}  // namespace farlod
