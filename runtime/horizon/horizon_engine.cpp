// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/horizon_engine.hpp"

#include <algorithm>
#include <cmath>

#include "base/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

using Lanes = PacketHorizon::Lanes;

/// The part of the sky of small gaps that is seen on average.
constexpr float sky_in_small_gaps = 0.3F;

Lanes sum(std::span<const PacketHorizon::Row> rows) {
  Lanes sums{};
  for (const PacketHorizon::Row& row : rows)
    for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += row[l];
  return sums;
}

}  // namespace

HorizonEngine::HorizonEngine(const AzimuthSampling& azimuths, SkyWeight weight, const FarHorizon& far,
                             const CellSilhouettes& silhouettes, OverhangGeometry& overhangs, float gap_tolerance,
                             JumpPlaces jumps)
    : azimuths_(azimuths),
      weight_(weight),
      silhouettes_(silhouettes),
      overhangs_(overhangs),
      gap_tolerance_(gap_tolerance),
      jump_places_(jumps),
      residual_(far, azimuths),
      group_(azimuths),
      recesses_(azimuths, silhouettes),
      jumps_(azimuths, silhouettes.upper_ends),
      sections_(azimuths),
      horizons_(azimuths, PacketHorizon::Edges::tracked),
      near_(azimuths) {}

void HorizonEngine::tell_profiles(ProfileRows rows, OnProfile on_profile) {
  FARLOD_EXPECTS(jump_places_ == JumpPlaces::at_edge_ends);
  profile_rows_ = rows;
  on_profile_ = std::move(on_profile);
  profile_.emplace(azimuths_);
}

template <class Begin>
void HorizonEngine::draw_grounded(std::span<const ReceiverPacket> packets, PacketHorizon::Edges edges, const Begin& begin) {
  while (grounded_.size() < packets.size()) grounded_.emplace_back(azimuths_, edges);
  const std::span horizons = std::span(grounded_).first(packets.size());
  for (PacketHorizon& horizon : horizons) horizon.clear(edges);
  if (pixels_ != nullptr) {
    pixels_->draw(packets, horizons);
    return;
  }
  for (std::size_t n = 0; n < packets.size(); ++n) begin(packets[n], horizons[n]);
  group_.raise(silhouettes_.grounded, packets, horizons);
  // What the grounded horizons hide is neither above an upper border nor in a gap
  const auto keep = [&](const OverhangEdges& all, OverhangEdges& in_sight) {
    group_.keep_raising(all.overhangs, packets, horizons, RaisingAt::wedges, in_sight.overhangs);
    group_.keep_raising(all.undersides, packets, horizons, RaisingAt::azimuths, in_sight.undersides);
  };
  keep(silhouettes_.near, in_sight_.near);
  keep(silhouettes_.far, in_sight_.far);
  if (in_sight_.has_undersides()) sections_.begin(packets, horizons);
}

void HorizonEngine::evaluate(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers) {
  FARLOD_EXPECTS(answers.size() == packets.size());
  // The residual horizon comes first: it is cheap, and culls edges
  draw_grounded(packets, HorizonJumps::edges_for(azimuths_),
                [this](const ReceiverPacket& packet, PacketHorizon& horizon) { residual_.raise_to_estimate(packet, horizon); });
  for (std::size_t n = 0; n < packets.size(); ++n) {
    std::swap(horizons_.grounded, grounded_[n]);
    evaluate(packets[n], answers[n]);
    if (profile_) on_profile_(n, *profile_);
  }
}

void HorizonEngine::evaluate_with_bounds(std::span<const ReceiverPacket> packets, std::span<PacketAnswer> answers) {
  FARLOD_EXPECTS(answers.size() == packets.size() && pixels_ == nullptr);
  draw_grounded(packets, PacketHorizon::Edges::tracked, [](const ReceiverPacket&, PacketHorizon&) {});
  certain().begin(packets, std::span(grounded_).first(packets.size()));
  for (std::size_t n = 0; n < packets.size(); ++n) {
    std::swap(horizons_.grounded, grounded_[n]);
    evaluate_with_bounds(packets[n], answers[n]);
    if (profile_) on_profile_(n, *profile_);
  }
}

void HorizonEngine::evaluate(const ReceiverPacket& receivers, PacketAnswer& answer) {
  if (pixels_ != nullptr) return evaluate(receivers, Overhead{}, answer);
  const Overhead overhead = recesses_.overhead_of(receivers, overhangs_.receivers_below(receivers));
  const auto begin = [this](const ReceiverPacket& packet, PacketHorizon& horizon) {
    residual_.raise_to_estimate(packet, horizon);
  };
  recesses_.draw_again(receivers, overhead, begin, horizons_.grounded);
  evaluate(receivers, overhead, answer);
}

void HorizonEngine::evaluate(const ReceiverPacket& receivers, const Overhead& overhead, PacketAnswer& answer,
                             const NearHorizons* near) {
  // Without overhangs in sight, the sky above it is the answer
  if (overhead.below == 0 && in_sight_.empty()) {
    const auto [sky, correction] = sky_above(horizons_.grounded, receivers, overhead);
    corrections_ = correction;
    for (std::size_t l = 0; l < sky.size(); ++l) answer.svf[l] = answer.drawn[l] = {sky[l], sky[l], sky[l]};
    answer.by_rays = 0;
    answer.decided_wedges = 0;
    return;
  }
  // Else it is the sky above the upper borders, plus what is seen in the gaps below the lower borders
  horizons_.upper_borders = horizons_.grounded;
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  horizons_.draw_overhangs(in_sight(overhead), receivers, overhead, FarGapEnd::lowest, near);
  const auto [sky, correction] = sky_above(horizons_.upper_borders, receivers, overhead);
  corrections_ = correction;
  const Lanes in_gaps = sky_in_gaps(receivers, overhead, sky);
  for (std::size_t l = 0; l < sky.size(); ++l) {
    const float sum = std::min(sky[l] + in_gaps[l], 1.0F);
    answer.svf[l] = answer.drawn[l] = {sum, sum, sum};
  }
  answer.by_rays = 0;
  answer.decided_wedges = 0;
}

void HorizonEngine::evaluate_with_bounds(const ReceiverPacket& receivers, PacketAnswer& answer) {
  const Overhead overhead = recesses_.overhead_of(receivers, overhangs_.receivers_below(receivers));
  recesses_.draw_again(
      receivers, overhead, [](const ReceiverPacket&, PacketHorizon&) {}, horizons_.grounded);
  near_.draw(horizons_.grounded, in_sight(overhead).near, receivers);
  const SkyAtAzimuths at_azimuths = profile_ ? bounds_at_azimuths(receivers, overhead) : SkyAtAzimuths{};
  residual_.raise_to_estimate(receivers, horizons_.grounded);
  evaluate(receivers, overhead, answer, &near_);
  Lanes estimates{};
  for (std::size_t l = 0; l < receivers.count; ++l) estimates[l] = answer.svf[l].estimate;
  const CertainSky::Bounds bounds = certain().bounds(near_, receivers, overhead, estimates);
  for (std::size_t l = 0; l < receivers.count; ++l) {
    SvfInterval& svf = answer.svf[l];
    const float drawn = svf.estimate;
    // Jumps are placed where they are for both ends, too
    answer.drawn[l] = {std::min(at_azimuths.low[l] + corrections_[l], drawn), drawn,
                       std::max(at_azimuths.high[l] + corrections_[l], drawn)};
    svf = within_error({bounds.low[l], std::clamp(drawn, bounds.low[l], bounds.high[l]), bounds.high[l]}, allowed_error_);
  }
  answer.by_rays |= bounds.decided;
  answer.decided_wedges = bounds.wedges;
}

CertainSky& HorizonEngine::certain() {
  if (!certain_) certain_.emplace(azimuths_, weight_, silhouettes_, residual_, overhangs_);
  return *certain_;
}

HorizonEngine::SkyAtAzimuths HorizonEngine::bounds_at_azimuths(const ReceiverPacket& receivers, const Overhead& overhead) {
  SkyAtAzimuths sky;
  // The most: sky above the residual's low bound, and all of the gaps, up to the highest borders
  horizons_.upper_borders.set_slopes(horizons_.grounded);
  horizons_.lower_borders.set_slopes(horizons_.grounded);
  residual_.raise_to_low(receivers, horizons_.upper_borders);
  residual_.raise_to_overhang(receivers, horizons_.lower_borders);
  horizons_.draw_overhangs(in_sight(overhead), receivers, overhead, FarGapEnd::highest, &near_);
  const Lanes in_gaps = sum(horizons_.find_sky_in_gaps(weight_, receivers, gap_rows_));
  sky.high = horizons_.upper_borders.sky_above(weight_, receivers);
  for (std::size_t l = 0; l < sky.high.size(); ++l) sky.high[l] += in_gaps[l];
  // The least: sky above its high bound, and nothing of the gaps
  residual_.raise_to_high(receivers, horizons_.upper_borders);
  sky.low = horizons_.upper_borders.sky_above(weight_, receivers);
  horizons_.grounded = near_.grounded();
  return sky;
}

HorizonJumps::SkyAbove HorizonEngine::sky_above(const PacketHorizon& horizon, const ReceiverPacket& receivers,
                                                const Overhead& overhead) {
  if (jump_places_ == JumpPlaces::between_azimuths) return {horizon.sky_above(weight_, receivers), {}};
  HorizonJumps::OfAzimuths of_azimuths;
  if (profile_) {
    begin_profile(horizon);
    of_azimuths.sky = profile_->sky;
    if (weight_ == SkyWeight::cosine) of_azimuths.for_light = profile_->light_sky;
    if (profile_rows_.solid_sky)
      (void)jumps_.sky_above(horizon, SkyWeight::solid_angle, receivers, overhead.in_recess, {.sky = profile_->solid_sky});
    if (profile_rows_.light_sky && weight_ != SkyWeight::cosine)
      (void)jumps_.sky_above(horizon, SkyWeight::cosine, receivers, overhead.in_recess, {.for_light = profile_->light_sky});
  }
  return jumps_.sky_above(horizon, weight_, receivers, overhead.in_recess, of_azimuths);
}

void HorizonEngine::begin_profile(const PacketHorizon& horizon) {
  for (std::size_t k = 0; k < azimuths_.size(); ++k) profile_->sky_from[k] = horizon.row(k);
  profile_->gap_from.clear();
  profile_->gap_to.clear();
  profile_->gap_share.clear();
  profile_->sky.resize(weight_ == SkyWeight::cosine ? azimuths_.size() : 0);
  if (profile_rows_.solid_sky) profile_->solid_sky.resize(azimuths_.size());
  profile_->light_sky.resize(profile_rows_.light_sky ? azimuths_.size() : 0);
}

Lanes HorizonEngine::sky_in_gaps(const ReceiverPacket& receivers, const Overhead& overhead, const Lanes& above) {
  if (horizons_.lower_borders.exceeds(horizons_.grounded) == 0) return {};
  // What is above the upper borders counts already
  horizons_.lower_borders.lower_to(horizons_.upper_borders);
  horizons_.grounded.find_sky_below(horizons_.lower_borders, weight_, receivers, gap_rows_);
  Lanes sky = sum(gap_rows_);
  std::uint32_t asked = 0;
  for (std::size_t l = 0; l < receivers.count; ++l) {
    const bool is_small = sky[l] <= gap_tolerance_ * above[l];
    if (!is_small) asked |= 1U << l;
    sky[l] = is_small ? sky_in_small_gaps * sky[l] : 0.0F;
  }
  const std::span<const OpenGap> open = asked == 0 ? std::span<const OpenGap>() : open_gaps(receivers, overhead, asked);
  for (const OpenGap& gap : open) sky[gap.lane] += gap.sky / static_cast<float>(azimuths_.size());
  if (profile_) profile_gaps(open, asked, receivers);
  return sky;
}

std::span<const OpenGap> HorizonEngine::open_gaps(const ReceiverPacket& receivers, const Overhead& overhead,
                                                  std::uint32_t asked) {
  const Gaps gaps{
      horizons_.grounded, horizons_.lower_borders, horizons_.far_lower_borders, horizons_.far_upper_borders, gap_rows_, asked};
  return overhead.in_recess != 0 ? sections_.find_any_open(overhangs_.facets_around_recesses(), gaps, weight_, receivers)
                                 : sections_.find_open(overhangs_.facets(), gaps, weight_, receivers);
}

void HorizonEngine::profile_gaps(std::span<const OpenGap> open, std::uint32_t asked, const ReceiverPacket& receivers) {
  const std::size_t count = azimuths_.size();
  for (SkyProfile::Rows* rows : {&profile_->gap_from, &profile_->gap_to, &profile_->gap_share}) rows->assign(count, {});
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t l = 0; l < receivers.count; ++l) {
      if (has_bit(asked, l) || gap_rows_[k][l] <= 0.0F) continue;
      profile_->gap_from[k][l] = horizons_.grounded.row(k)[l];
      profile_->gap_to[k][l] = horizons_.lower_borders.row(k)[l];
      profile_->gap_share[k][l] = sky_in_small_gaps;
    }
  for (const OpenGap& gap : open) {
    profile_->gap_from[gap.azimuth][gap.lane] = gap.from;
    profile_->gap_to[gap.azimuth][gap.lane] = gap.to;
    profile_->gap_share[gap.azimuth][gap.lane] = 1.0F;
  }
  // A gap that is split: the share of all between its ends
  sky_kernels().find_sky_between(profile_->gap_from.front().data(), profile_->gap_to.front().data(), receivers, azimuths_.view(),
                                 weight_ == SkyWeight::solid_angle, gap_rows_.front().data());
  for (const OpenGap& gap : open) {
    const float all = gap_rows_[gap.azimuth][gap.lane] * static_cast<float>(count);
    if (gap.is_split && all > 0.0F) profile_->gap_share[gap.azimuth][gap.lane] = std::min(gap.sky / all, 1.0F);
  }
}

}  // namespace farlod
