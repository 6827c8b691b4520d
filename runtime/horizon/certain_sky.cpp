// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/certain_sky.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/cancellation.hpp"
#include "horizon/wedge_kernels.hpp"

namespace farlod {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;
/// Facets are not asked of gaps in which less of the sky may be seen: in all that a receiver has, and in a wedge.
constexpr double least_gaps = 0.003;
constexpr float least_gap_rad = 2e-4F;
/// Facets below a gap are looked at no farther down than to this share of the slope that it begins at.
constexpr float least_lid = 0.7F;

/// A horizon with borders of the far city, too. `both` is room for it, and its drawn() are these borders.
const PacketHorizon& with_far(const PacketHorizon& near, const SilhouetteEdges& far, const ReceiverPacket& receivers,
                              PacketHorizon& both) {
  if (far.empty()) return near;
  both.begin_above(near);
  both.raise(far, receivers);
  return both;
}

}  // namespace

CertainSky::CertainSky(const AzimuthSampling& azimuths, SkyWeight weight, const CellSilhouettes& silhouettes,
                       const ResidualHorizon& residual, OverhangGeometry& overhangs)
    : silhouettes_(silhouettes),
      lower_ends_(std::array<const SilhouetteEdges*, 2>{&silhouettes.near.undersides, &silhouettes.far.undersides}),
      residual_(residual),
      overhangs_(overhangs),
      weight_(weight),
      wanted_(wanted_width),
      group_(azimuths),
      envelope_(azimuths, weight, silhouettes.upper_ends),
      wedge_gaps_(azimuths),
      upper_(azimuths, PacketHorizon::Edges::tracked),
      lower_(azimuths),
      above_far_(azimuths, PacketHorizon::Edges::tracked),
      reached_(azimuths.size()) {}

void CertainSky::keep(const AllowedError& allowed) {
  allowed_.emplace(allowed);
  wanted_ = std::min(wanted_, allowed.error);
}

void CertainSky::begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> grounded) {
  const auto keep = [&](const SilhouetteEdges& all, SilhouetteEdges& kept) {
    group_.keep_raising(all, packets, grounded, RaisingAt::wedges, kept);
  };
  keep(silhouettes_.near.undersides, near_undersides_);
  keep(silhouettes_.far.overhangs, far_.overhangs);
  keep(silhouettes_.far.undersides, far_.undersides);
  lower_places_.find(numbers_of(std::array<const SilhouetteEdges*, 2>{&near_undersides_, &far_.undersides}), lower_ends_);
  far_places_.find(numbers_of(std::array<const SilhouetteEdges*, 1>{&far_.overhangs}), silhouettes_.upper_ends);
  wedge_gaps_.begin(packets, grounded);
}

double CertainSky::Open::farther_end_from(double value, std::size_t lane) const {
  const double between = std::clamp(value, sky.low[lane], std::max(sky.low[lane], high(lane)));
  return std::max(between - sky.low[lane], high(lane) - between);
}

/// Sky is what lies above the envelope of all upper borders, and at most what lies between that of the grounded edges and the
/// lower borders.
CertainSky::Open CertainSky::open_sky(const NearHorizons& near, const ReceiverPacket& receivers, const Overhead& overhead) {
  residual_.find_in_wedges(receivers, in_wedges_);
  envelope_.see(near.grounded(), receivers);
  find_rising(std::array{&near.grounded().drawn()}, envelope_.least_horizons(), envelope_.size(), grounded_);
  places_.find(grounded_.numbers(), silhouettes_.upper_ends);
  tops_.assign(envelope_.size(), {});
  envelope_.raise_to_ends(places_.batches(), tops_);
  upper_borders_ = &with_far(near.upper_borders(), far_.overhangs, receivers, upper_);
  Open open;
  open.gaps = most_in_gaps(near, receivers, overhead.below);
  list_gaps(near, receivers, open, overhead);
  envelope_.keep_terms(allowed_ || !gaps_.empty());
  open.sky = sky_above_borders(near, receivers);
  close_above(overhead, open);
  narrow_by_facets(receivers, overhead, open);
  for (std::size_t l = 0; l < receivers.count; ++l)
    if (has_bit(overhead.in_recess, l))
      open.gaps[l] = static_cast<double>(envelope_.size()) * most_in_recess(receivers, l, overhead) / turn_rad;
  return open;
}

void CertainSky::close_above(const Overhead& overhead, Open& open) {
  if (overhead.below == 0) return;
  for (std::size_t l = 0; l < packet_lanes; ++l) {
    if (!has_bit(overhead.below, l)) continue;
    open.sky.low[l] = open.sky.high[l] = 0.0;
    for (std::size_t k = 0; k < envelope_.size(); ++k) envelope_.terms().low[k][l] = envelope_.terms().high[k][l] = 0.0F;
  }
}

void CertainSky::find_far_tops(const NearHorizons& near, const ReceiverPacket& receivers) {
  far_tops_.assign(envelope_.size(), {});
  if (far_.overhangs.empty()) return;
  envelope_.raise_to_ends(far_places_.batches(), far_tops_);
  const PacketHorizon &grounded = near.grounded(), &drawn = with_far(grounded, far_.overhangs, receivers, above_far_);
  for (std::size_t k = 0; k < envelope_.size(); ++k)
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      float& top = far_tops_[k][l];
      for (const std::size_t azimuth : {k, k + 1 < envelope_.size() ? k + 1 : 0})
        if (drawn.row(azimuth)[l] > grounded.row(azimuth)[l]) top = std::max(top, drawn.row(azimuth)[l]);
      top *= envelope_.shape().widened;
    }
}

void CertainSky::list_gaps(const NearHorizons& near, const ReceiverPacket& receivers, const Open& open,
                           const Overhead& overhead) {
  gaps_.clear();
  std::uint32_t asked = 0;
  for (std::size_t l = 0; l < receivers.count; ++l)
    if (open.gaps[l] > least_gaps && !has_bit(overhead.in_recess, l)) asked |= 1U << l;
  if (asked == 0) return;
  for (std::uint32_t k = 0; k < envelope_.size(); ++k) {
    if (reached_[k] == 0) continue;
    const PacketHorizon::Row& most = envelope_.terms().gaps[k];
    for (std::uint32_t bits = asked; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::uint32_t>(std::countr_zero(bits));
      if (most[l] > least_gap_rad) gaps_.push_back({k, l, envelope_.most(tops_, k, l), lower_borders_[k][l]});
    }
  }
  if (gaps_.empty()) return;
  find_far_tops(near, receivers);
  for (WedgeGaps::Gap& gap : gaps_) {
    const float far = std::max(in_wedges_.most[gap.azimuth][gap.lane], far_tops_[gap.azimuth][gap.lane]);
    const float lid = std::min(envelope_.lid(gap.azimuth, gap.lane), gap.from);
    // Far below the gap many more facets are met, and little is seen between slopes that are close
    if (lid > least_lid * gap.from && envelope_.level_sky_between(lid, gap.from) > 0.5F * least_gap_rad) {
      gap.lid = lid;
      if (far <= lid) gap.below = envelope_.open_below(gap.from, gap.to, gap.azimuth, gap.lane);
    }
    gap.from = std::max(gap.from, far);
  }
}

void CertainSky::narrow_by_facets(const ReceiverPacket& receivers, const Overhead& overhead, Open& open) {
  if (gaps_.empty()) return;
  for (WedgeGaps::Gap& gap : gaps_) {
    const float top = std::max(gap.from, envelope_.most(tops_, gap.azimuth, gap.lane));
    gap.top = has_bit(overhead.below, gap.lane) ? std::numeric_limits<float>::infinity() : top;
    gap.to = std::clamp(gap.to, gap.from, gap.top);
  }
  const std::span found = wedge_gaps_.find(gaps_, overhangs_.facets(), envelope_.shape(), weight_, receivers);
  for (std::size_t n = 0; n < gaps_.size(); ++n) {
    const auto [k, l] = std::pair{gaps_[n].azimuth, gaps_[n].lane};
    float &low = envelope_.terms().low[k][l], &gap = envelope_.terms().gaps[k][l];
    const double least = term_of(found[n].open, k, receivers, l, overhead);
    const float raised = std::max(low, static_cast<float>(least)),
                left = std::min(gap, std::max(std::min(gap - found[n].hidden, found[n].most), 0.0F));
    open.sky.low[l] += (static_cast<double>(raised) - static_cast<double>(low)) / turn_rad;
    open.gaps[l] += (static_cast<double>(left) - static_cast<double>(gap)) / turn_rad;
    low = raised;
    gap = left;
  }
}

double CertainSky::term_of(double sky, std::size_t wedge, const ReceiverPacket& receivers, std::size_t l,
                           const Overhead& overhead) const {
  return has_bit(overhead.below, l) ? sky : envelope_.term_of(sky, wedge, receivers, l);
}

PacketEnvelope::Bounds CertainSky::sky_above_borders(const NearHorizons& near, const ReceiverPacket& receivers) {
  const PacketEnvelope::Hiding hiding{in_wedges_.least, in_wedges_.most};
  overhangs_above_.clear();
  if (has_overhangs(near)) {
    envelope_.see(*upper_borders_, receivers);
    find_rising(drawn_overhangs(near), envelope_.least_horizons(), envelope_.size(), overhangs_above_);
    places_.find_further(overhangs_above_.numbers(), silhouettes_.upper_ends);
    envelope_.raise_to_ends(places_.further_batches(), tops_);
  }
  return envelope_.bounds({std::array<const DrawnEdges*, 2>{&grounded_, &overhangs_above_}, tops_}, hiding, wanted_);
}

std::vector<const DrawnEdges*> CertainSky::drawn_overhangs(const NearHorizons& near) const {
  std::vector<const DrawnEdges*> drawn;
  if (near.has_upper_borders()) drawn.push_back(&near.upper_borders().drawn());
  if (!far_.overhangs.empty()) drawn.push_back(&upper_.drawn());
  return drawn;
}

CertainSky::Bounds CertainSky::bounds(const NearHorizons& near, const ReceiverPacket& receivers, const Overhead& overhead,
                                      const Lanes& estimates) {
  Open open = open_sky(near, receivers, overhead);
  Bounds bounds;
  for (std::size_t l = 0; l < receivers.count; ++l) {
    if (allowed_) decide(receivers, l, overhead, static_cast<double>(estimates[l]), open, bounds);
    bounds.low[l] = static_cast<float>(std::clamp(open.sky.low[l] - rounding_of_bounds, 0.0, 1.0));
    bounds.high[l] = static_cast<float>(std::clamp(open.high(l) + rounding_of_bounds, 0.0, 1.0));
  }
  return bounds;
}

PacketEnvelope::Sums CertainSky::most_in_gaps(const NearHorizons& near, const ReceiverPacket& receivers, std::uint32_t below) {
  choose_gaps(near, below);
  if (std::find(reached_.begin(), reached_.end(), std::uint8_t{1}) == reached_.end()) return {};
  lower_borders_ = lower_borders(near, receivers);
  return envelope_.most_in_gaps(tops_, {lower_borders_, reached_});
}

/// Where no upper border rises above the lower one of both horizons of a wedge, nothing hides more than the horizons and the far
/// map's low bound, above which all counts as sky already. Elsewhere sky may be seen below a lower border, even below one that no
/// horizon is lower than.
void CertainSky::choose_gaps(const NearHorizons& near, std::uint32_t below) {
  reached_ = in_wedges_.reached_below_low;
  residual_borders_ = in_wedges_.overhang_below_low;
  if (!has_overhangs(near) && below == 0) return;
  may_hide_.assign(reached_.size(), below != 0 ? 1 : 0);
  if (below == 0) {
    // One that is not drawn, since others are higher at both azimuths of its wedges, reaches where these do
    for (const DrawnEdges* drawn : drawn_overhangs(near))
      wedge_end_kernels().mark_reached(drawn->spans(), drawn->size(), envelope_.least_horizons(),
                                       static_cast<std::uint32_t>(may_hide_.size()), may_hide_.data());
  }
  for (std::size_t k = 0; k < reached_.size(); ++k)
    if (may_hide_[k] != 0) reached_[k] = 1;
  if (residual_.is_grounded()) return;
  chosen_borders_ = in_wedges_.overhang_below_low;
  for (std::size_t k = 0; k < reached_.size(); ++k)
    if (may_hide_[k] != 0) chosen_borders_[k] = in_wedges_.overhang[k];
  residual_borders_ = chosen_borders_;
}

std::span<const PacketHorizon::Row> CertainSky::lower_borders(const NearHorizons& near, const ReceiverPacket& receivers) {
  if (!has_undersides()) return residual_borders_;
  return envelope_.find_lower_borders(lower_places_.batches(), with_far(near.lower_borders(), far_.undersides, receivers, lower_),
                                      {residual_borders_, reached_});
}

double CertainSky::OpenWedges::width(std::size_t k) const { return high(k) + gap(k) - low(k); }

/// Their numbers as a heap, the widest first.
std::vector<std::size_t> CertainSky::OpenWedges::widest_first() const {
  std::vector<std::size_t> wedges(envelope.size());
  std::iota(wedges.begin(), wedges.end(), std::size_t{0});
  std::make_heap(wedges.begin(), wedges.end(), [this](std::size_t a, std::size_t b) { return width(a) < width(b); });
  return wedges;
}

double CertainSky::most_in_recess(const ReceiverPacket& receivers, std::size_t l, const Overhead& overhead) const {
  if (!has_bit(overhead.in_recess, l)) return 0.0;
  // By the cosine, one azimuth tells at most n_z + π/2 · √(n_x² + n_y²): the integrals of 2 cos θ sin θ and of 2 sin²θ
  const double lean = std::hypot(receivers.normal_x[l], receivers.normal_y[l]);
  const bool is_cosine = weight_ == SkyWeight::cosine;
  const double most = is_cosine ? std::max(0.0F, receivers.normal_z[l]) + 0.5 * std::numbers::pi * lean : 1.0;
  return most * turn_rad / static_cast<double>(envelope_.size());
}

void CertainSky::decide(const ReceiverPacket& receivers, std::size_t l, const Overhead& overhead, double estimate, Open& open,
                        Bounds& bounds) {
  const double allowed = std::max(0.0, allowed_->error - rounding_of_bounds);
  if (open.farther_end_from(estimate, l) <= allowed) return;
  const OpenWedges wedges{envelope_, reached_, l, most_in_recess(receivers, l, overhead)};
  const auto narrower = [&](std::size_t a, std::size_t b) { return wedges.width(a) < wedges.width(b); };
  std::vector<std::size_t> widest = wedges.widest_first();
  while (open.farther_end_from(estimate, l) > allowed && !widest.empty() && wedges.width(widest.front()) > 0.0) {
    throw_if_cancelled(allowed_->stop);
    std::pop_heap(widest.begin(), widest.end(), narrower);
    const std::size_t k = widest.back();
    widest.pop_back();
    const double term = exact_term(receivers, l, overhead, k);
    open.sky.low[l] += (term - wedges.low(k)) / turn_rad;
    open.sky.high[l] += (term - wedges.high(k)) / turn_rad;
    open.gaps[l] -= wedges.gap(k) / turn_rad;
    ++bounds.wedges;
    bounds.decided |= 1U << l;
  }
}

double CertainSky::exact_term(const ReceiverPacket& receivers, std::size_t l, const Overhead& overhead, std::size_t wedge) {
  const Point3d place = allowed_->city.scene_from_cell({receivers.x[l], receivers.y[l], receivers.z[l]}, allowed_->cell);
  if (!exact_) exact_.emplace(allowed_->city.triangles());
  const double sky = exact_->sky_of_wedge(envelope_.wedge(wedge), place,
                                          {receivers.normal_x[l], receivers.normal_y[l], receivers.normal_z[l]}, weight_);
  return term_of(sky, wedge, receivers, l, overhead);
}

}  // namespace farlod
