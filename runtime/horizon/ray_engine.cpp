// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/ray_engine.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

constexpr std::uint32_t bit_of(std::size_t lane) { return 1U << lane; }

std::uint32_t whole(float count) { return static_cast<std::uint32_t>(count); }

}  // namespace

RayEngine::RayEngine(const RayFan& fan, const FarHorizon& far, const CellSkyline& skyline, const HangingCity& hanging,
                     const Occluder& scene, bool wants_bounds)
    : fan_(fan),
      skyline_(skyline),
      hanging_(hanging),
      scene_(scene),
      wants_bounds_(wants_bounds),
      unnamed_(far, fan.ring()),
      hidden_(fan.ring()),
      likely_(fan.ring()),
      open_(fan.ring()),
      outlines_(fan.ring()) {}

std::vector<FreeRays> RayEngine::count(std::span<const Receiver> receivers) {
  FARLOD_EXPECTS(!receivers.empty() && receivers.size() <= ReceiverPacket::lanes);
  look(receivers);
  trace();
  const PacketHorizon::Lanes high = hidden_.count_over(fan_.slopes());
  const PacketHorizon::Lanes likely = wants_bounds_ ? likely_.count_over(fan_.slopes()) : high;
  const PacketHorizon::Lanes low = wants_bounds_ ? open_.count_over(fan_.slopes()) : high;
  std::vector<FreeRays> free;
  for (std::size_t l = 0; l < receivers.size(); ++l) free.push_back({whole(low[l]), whole(likely[l]), whole(high[l])});
  for (const Blocked& b : blocked_) {
    const float slope = fan_.slopes()[b.azimuth];
    const std::uint32_t were_likely = wants_bounds_ ? b.bits & likely_.below(b.azimuth, slope) : b.bits,
                        were_certain = wants_bounds_ ? b.bits & open_.below(b.azimuth, slope) : b.bits;
    for (std::size_t l = 0; l < free.size(); ++l) {
      free[l].high -= (b.bits & bit_of(l)) != 0 ? 1U : 0U;
      free[l].likely -= (were_likely & bit_of(l)) != 0 ? 1U : 0U;
      free[l].low -= (were_certain & bit_of(l)) != 0 ? 1U : 0U;
    }
  }
  return free;
}

void RayEngine::look(std::span<const Receiver> receivers) {
  packet_ = {};
  for (const Receiver& r : receivers) packet_.add(r);
  origins_ = {packet_.x, packet_.y, packet_.z};
  hidden_.clear();
  if (wants_bounds_)
    unnamed_.raise_lower(packet_, hidden_);
  else
    unnamed_.raise_likely(packet_, hidden_);
  hidden_.raise(skyline_.standing, packet_);
  if (wants_bounds_) look_unnamed();
}

void RayEngine::look_unnamed() {
  likely_ = hidden_;
  unnamed_.raise_likely(packet_, likely_);
  open_ = likely_;
  unnamed_.raise_upper(packet_, open_);
}

void RayEngine::trace() {
  blocked_.clear();
  if (hanging_.empty()) return;
  outlines_.clear();
  hanging_.raise(packet_, outlines_);
  const std::uint32_t covered = hanging_.covered(packet_);
  hidden_.find_between(outlines_, fan_.slopes(), azimuths_);
  if (covered != 0) {
    azimuths_.resize(fan_.size());
    std::iota(azimuths_.begin(), azimuths_.end(), 0U);
  }
  for (const std::uint32_t k : azimuths_) {
    const float slope = fan_.slopes()[k];
    trace(k, hidden_.below(k, slope) & (~outlines_.below(k, slope) | covered));
  }
}

void RayEngine::trace(std::size_t azimuth, std::uint32_t wanted) {
  const std::uint32_t bits = scene_.blocked(origins_, fan_.direction(azimuth), least_distance_m, wanted);
  if (bits != 0) blocked_.push_back({static_cast<std::uint32_t>(azimuth), bits});
}

std::uint64_t RayEngine::settle(const Occluder& city, const RayOrigins& origins, std::uint32_t doubtful,
                                std::span<FreeRays> free) const {
  FARLOD_EXPECTS(wants_bounds_);
  std::uint64_t rays = 0;
  auto blocked = blocked_.begin();
  for (std::size_t l = 0; l < free.size(); ++l)
    if ((doubtful & bit_of(l)) != 0) free[l].high = free[l].low;
  for (std::uint32_t k = 0; k < fan_.size(); ++k) {
    const float slope = fan_.slopes()[k];
    const bool meets_hanging = blocked != blocked_.end() && blocked->azimuth == k;
    const std::uint32_t met = meets_hanging ? (blocked++)->bits : 0;
    const std::uint32_t wanted = hidden_.below(k, slope) & ~open_.below(k, slope) & ~met & doubtful;
    rays += static_cast<std::uint64_t>(std::popcount(wanted));
    const std::uint32_t open = wanted & ~city.blocked(origins, fan_.direction(k), least_distance_m, wanted);
    for (std::size_t l = 0; l < free.size(); ++l) free[l].high += (open & bit_of(l)) != 0 ? 1U : 0U;
  }
  for (std::size_t l = 0; l < free.size(); ++l)
    if ((doubtful & bit_of(l)) != 0) free[l].low = free[l].likely = free[l].high;
  return rays;
}

}  // namespace farlod
