// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/ray_engine.hpp"

#include <algorithm>
#include <bit>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

constexpr std::uint32_t bit_of(std::size_t lane) { return 1U << lane; }

std::uint32_t whole(float count) { return static_cast<std::uint32_t>(count); }

}  // namespace

RayEngine::RayEngine(const RayFan& fan, const FarHorizon& far, const CellSilhouettes& silhouettes, OverhangGeometry& overhangs,
                     bool wants_bounds)
    : fan_(fan),
      silhouettes_(silhouettes),
      overhangs_(overhangs),
      wants_bounds_(wants_bounds),
      residual_(far, fan.ring()),
      estimate_(fan.ring()),
      certain_(fan.ring()),
      open_(fan.ring()) {}

std::vector<FreeRays> RayEngine::count(std::span<const Receiver> receivers) {
  FARLOD_EXPECTS(!receivers.empty() && receivers.size() <= ReceiverPacket::lanes);
  look(receivers);
  trace();
  const PacketHorizon::Lanes estimate = estimate_.upper.count_over(fan_.slopes());
  const PacketHorizon::Lanes high = wants_bounds_ ? certain_.upper.count_over(fan_.slopes()) : estimate;
  const PacketHorizon::Lanes low = wants_bounds_ ? open_.count_over(fan_.slopes()) : estimate;
  std::vector<FreeRays> free;
  for (std::size_t l = 0; l < receivers.size(); ++l) free.push_back({whole(low[l]), whole(estimate[l]), whole(high[l])});
  for (const Passing& p : passing_)
    for (std::size_t l = 0; l < free.size(); ++l) {
      free[l].estimate += (p.estimate & bit_of(l)) != 0 ? 1U : 0U;
      free[l].high += (p.possible & bit_of(l)) != 0 ? 1U : 0U;
    }
  if (!wants_bounds_)
    for (FreeRays& f : free) f.low = f.high = f.estimate;
  return free;
}

void RayEngine::look(std::span<const Receiver> receivers) {
  packet_ = {};
  for (const Receiver& r : receivers) packet_.add(r);
  const std::uint32_t covered = overhangs_.covered(packet_);
  // The estimate: the residual city is grounded
  estimate_.grounded.clear();
  residual_.raise_to_estimate(packet_, estimate_.grounded);
  estimate_.grounded.raise(silhouettes_.grounded, packet_);
  estimate_.upper = estimate_.borders = estimate_.grounded;
  estimate_.draw_overhangs(silhouettes_, packet_, covered, FarGaps::estimate);
  estimate_.borders.lower_to(estimate_.upper);
  if (!wants_bounds_) return;
  // What is certain
  certain_.grounded.clear();
  certain_.grounded.raise(silhouettes_.grounded, packet_);
  certain_.upper = certain_.borders = certain_.grounded;
  residual_.raise_to_low(packet_, certain_.upper);
  residual_.raise_to_overhang(packet_, certain_.borders);
  certain_.draw_overhangs(silhouettes_, packet_, covered, FarGaps::possible);
  certain_.borders.lower_to(certain_.upper);
  open_ = estimate_.upper;
  residual_.raise_to_high(packet_, open_);
}

std::uint32_t RayEngine::in_gap(const OverhangHorizons& h, std::uint32_t azimuth, float slope) {
  const std::uint32_t in_far = h.far_borders.below(azimuth, slope) & ~h.far_upper.below(azimuth, slope);
  return h.grounded.below(azimuth, slope) & ~h.borders.below(azimuth, slope) & ~in_far;
}

void RayEngine::trace() {
  passing_.clear();
  const bool has_gaps =
      estimate_.borders.above(estimate_.grounded) != 0 || (wants_bounds_ && certain_.borders.above(certain_.grounded) != 0);
  if (!has_gaps) return;
  const PlacedScene scene = overhangs_.scene();
  const RayOrigins origins = scene.origins_of(packet_);
  for (std::uint32_t k = 0; k < fan_.size(); ++k) {
    const float slope = fan_.slopes()[k];
    const std::uint32_t estimate = in_gap(estimate_, k, slope), possible = wants_bounds_ ? in_gap(certain_, k, slope) : 0U;
    const std::uint32_t wanted = estimate | possible;
    if (wanted == 0) continue;
    const std::uint32_t free = wanted & ~scene.occluder.blocked(origins, fan_.direction(k), least_distance_m, wanted);
    if (free != 0) passing_.push_back({k, free & estimate, free & possible});
  }
}

std::uint64_t RayEngine::retrace(const Occluder& city, const RayOrigins& origins, std::uint32_t doubtful,
                                std::span<FreeRays> free) const {
  FARLOD_EXPECTS(wants_bounds_);
  std::uint64_t rays = 0;
  auto passing = passing_.begin();
  for (std::size_t l = 0; l < free.size(); ++l)
    if ((doubtful & bit_of(l)) != 0) free[l].high = free[l].low;
  for (std::uint32_t k = 0; k < fan_.size(); ++k) {
    const float slope = fan_.slopes()[k];
    const bool passes = passing != passing_.end() && passing->azimuth == k;
    const std::uint32_t below = passes ? (passing++)->possible : 0;
    const std::uint32_t wanted = ((certain_.upper.below(k, slope) & ~open_.below(k, slope)) | below) & doubtful;
    rays += static_cast<std::uint64_t>(std::popcount(wanted));
    const std::uint32_t open = wanted & ~city.blocked(origins, fan_.direction(k), least_distance_m, wanted);
    for (std::size_t l = 0; l < free.size(); ++l) free[l].high += (open & bit_of(l)) != 0 ? 1U : 0U;
  }
  for (std::size_t l = 0; l < free.size(); ++l)
    if ((doubtful & bit_of(l)) != 0) free[l].low = free[l].estimate = free[l].high;
  return rays;
}

}  // namespace farlod
