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

RayEngine::RayEngine(const RayFan& fan, const FarHorizon& far, const CellSkyline& skyline, OverhangGeometry& overhangs,
                     bool wants_bounds)
    : fan_(fan),
      skyline_(skyline),
      overhangs_(overhangs),
      wants_bounds_(wants_bounds),
      unnamed_(far, fan.ring()),
      horizons_(fan.ring()),
      likely_(fan.ring()),
      open_(fan.ring()),
      unnamed_likely_(fan.ring()) {}

std::vector<FreeRays> RayEngine::count(std::span<const Receiver> receivers) {
  FARLOD_EXPECTS(!receivers.empty() && receivers.size() <= ReceiverPacket::lanes);
  look(receivers);
  trace();
  const PacketHorizon::Lanes high = horizons_.upper.count_over(fan_.slopes());
  const PacketHorizon::Lanes likely = wants_bounds_ ? likely_.count_over(fan_.slopes()) : high;
  const PacketHorizon::Lanes low = wants_bounds_ ? open_.count_over(fan_.slopes()) : high;
  std::vector<FreeRays> free;
  for (std::size_t l = 0; l < receivers.size(); ++l) free.push_back({whole(low[l]), whole(likely[l]), whole(high[l])});
  for (const Passing& p : passing_)
    for (std::size_t l = 0; l < free.size(); ++l) {
      free[l].high += (p.bits & bit_of(l)) != 0 ? 1U : 0U;
      free[l].likely += (p.likely & bit_of(l)) != 0 ? 1U : 0U;
      // What lies behind is not certain
      free[l].low += !wants_bounds_ && (p.bits & bit_of(l)) != 0 ? 1U : 0U;
    }
  return free;
}

void RayEngine::look(std::span<const Receiver> receivers) {
  packet_ = {};
  for (const Receiver& r : receivers) packet_.add(r);
  const std::uint32_t covered = overhangs_.covered(packet_);
  horizons_.grounded.clear();
  if (!wants_bounds_) unnamed_.raise_likely(packet_, horizons_.grounded);
  horizons_.grounded.raise(skyline_.grounded, packet_);
  horizons_.upper = horizons_.borders = horizons_.grounded;
  if (wants_bounds_) {
    unnamed_.raise_lower(packet_, horizons_.upper);
    unnamed_.raise_overhang(packet_, horizons_.borders);
  }
  horizons_.draw_overhangs(skyline_, packet_, covered, wants_bounds_ ? FarGaps::possible : FarGaps::likely);
  horizons_.borders.lower_to(horizons_.upper);
  if (wants_bounds_) look_unnamed();
}

void RayEngine::look_unnamed() {
  unnamed_likely_.clear();
  unnamed_.raise_likely(packet_, unnamed_likely_);
  likely_ = horizons_.upper;
  unnamed_.raise_likely(packet_, likely_);
  open_ = likely_;
  unnamed_.raise_upper(packet_, open_);
}

void RayEngine::trace() {
  passing_.clear();
  if (horizons_.borders.above(horizons_.grounded) == 0) return;
  horizons_.grounded.find_between(horizons_.borders, fan_.slopes(), azimuths_);
  if (azimuths_.empty()) return;
  const PlacedScene scene = overhangs_.scene();
  const RayOrigins origins = scene.origins_of(packet_);
  for (const std::uint32_t k : azimuths_) {
    const float slope = fan_.slopes()[k];
    const std::uint32_t in_far = horizons_.far_borders.below(k, slope) & ~horizons_.far_upper.below(k, slope);
    const std::uint32_t wanted = horizons_.grounded.below(k, slope) & ~horizons_.borders.below(k, slope) & ~in_far;
    const std::uint32_t bits = wanted & ~scene.occluder.blocked(origins, fan_.direction(k), least_distance_m, wanted);
    const std::uint32_t likely = wants_bounds_ ? bits & unnamed_likely_.below(k, slope) : bits;
    if (bits != 0) passing_.push_back({k, bits, likely});
  }
}

std::uint64_t RayEngine::settle(const Occluder& city, const RayOrigins& origins, std::uint32_t doubtful,
                                std::span<FreeRays> free) const {
  FARLOD_EXPECTS(wants_bounds_);
  std::uint64_t rays = 0;
  auto passing = passing_.begin();
  for (std::size_t l = 0; l < free.size(); ++l)
    if ((doubtful & bit_of(l)) != 0) free[l].high = free[l].low;
  for (std::uint32_t k = 0; k < fan_.size(); ++k) {
    const float slope = fan_.slopes()[k];
    const bool passes = passing != passing_.end() && passing->azimuth == k;
    const std::uint32_t below = passes ? (passing++)->bits : 0;
    const std::uint32_t wanted = ((horizons_.upper.below(k, slope) & ~open_.below(k, slope)) | below) & doubtful;
    rays += static_cast<std::uint64_t>(std::popcount(wanted));
    const std::uint32_t open = wanted & ~city.blocked(origins, fan_.direction(k), least_distance_m, wanted);
    for (std::size_t l = 0; l < free.size(); ++l) free[l].high += (open & bit_of(l)) != 0 ? 1U : 0U;
  }
  for (std::size_t l = 0; l < free.size(); ++l)
    if ((doubtful & bit_of(l)) != 0) free[l].low = free[l].likely = free[l].high;
  return rays;
}

}  // namespace farlod
