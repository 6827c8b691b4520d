// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "rays/ray_engine.hpp"

#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

constexpr std::uint32_t bit_of(std::size_t lane) { return 1U << lane; }

std::uint32_t whole(float count) { return static_cast<std::uint32_t>(count); }

}  // namespace

RayEngine::RayEngine(const DirectionSampling& directions, const FarHorizon& far, const CellSilhouettes& silhouettes,
                     OverhangGeometry& overhangs, bool wants_bounds, std::stop_token stop)
    : directions_(directions),
      silhouettes_(silhouettes),
      overhangs_(overhangs),
      wants_bounds_(wants_bounds),
      stop_(std::move(stop)),
      residual_(far, directions.azimuths()),
      recesses_(directions.azimuths(), silhouettes),
      for_estimate_(directions.azimuths()),
      for_high_(directions.azimuths()),
      for_low_(directions.azimuths()) {}

std::vector<FreeRays> RayEngine::count(std::span<const Receiver> receivers) {
  FARLOD_EXPECTS(!receivers.empty() && receivers.size() <= ReceiverPacket::lanes);
  draw_horizons(receivers);
  trace_gaps();
  const PacketHorizon::Lanes estimate = for_estimate_.upper_borders.count_above(directions_.slopes());
  const PacketHorizon::Lanes high = wants_bounds_ ? for_high_.upper_borders.count_above(directions_.slopes()) : estimate;
  const PacketHorizon::Lanes low = wants_bounds_ ? for_low_.count_above(directions_.slopes()) : estimate;
  // Rays above the upper borders, and those that pass through gaps
  std::vector<FreeRays> free;
  for (std::size_t l = 0; l < receivers.size(); ++l) free.push_back({whole(low[l]), whole(estimate[l]), whole(high[l])});
  for (const GapRay& ray : gap_rays_)
    for (std::size_t l = 0; l < free.size(); ++l) {
      free[l].estimate += (ray.estimate & bit_of(l)) != 0 ? 1U : 0U;
      free[l].high += (ray.high & bit_of(l)) != 0 ? 1U : 0U;
    }
  if (!wants_bounds_)
    for (FreeRays& f : free) f.low = f.high = f.estimate;
  return free;
}

void RayEngine::draw_horizons(std::span<const Receiver> receivers) {
  packet_ = {};
  for (const Receiver& r : receivers) packet_.add(r);
  const Overhead overhead = recesses_.overhead_of(packet_, overhangs_.receivers_below(packet_));
  // The estimate: the residual city is grounded
  const auto begin = [this](const ReceiverPacket& packet, PacketHorizon& horizon) {
    residual_.raise_to_estimate(packet, horizon);
  };
  for_estimate_.grounded.clear();
  begin(packet_, for_estimate_.grounded);
  for_estimate_.grounded.raise(silhouettes_.grounded, packet_);
  recesses_.draw_again(packet_, overhead, begin, for_estimate_.grounded);
  for_estimate_.upper_borders = for_estimate_.lower_borders = for_estimate_.grounded;
  for_estimate_.draw_overhangs(silhouettes_, packet_, overhead, FarGapEnd::lowest);
  for_estimate_.lower_borders.lower_to(for_estimate_.upper_borders);
  if (wants_bounds_) draw_bounds(overhead);
}

void RayEngine::draw_bounds(const Overhead& overhead) {
  throw_if_cancelled(stop_);
  // The high count: the residual's low bound, and gaps up to the highest borders
  for_high_.grounded.clear();
  for_high_.grounded.raise(silhouettes_.grounded, packet_);
  recesses_.draw_again(
      packet_, overhead, [](const ReceiverPacket&, PacketHorizon&) {}, for_high_.grounded);
  for_high_.upper_borders = for_high_.lower_borders = for_high_.grounded;
  residual_.raise_to_low(packet_, for_high_.upper_borders);
  residual_.raise_to_overhang(packet_, for_high_.lower_borders);
  for_high_.draw_overhangs(silhouettes_, packet_, overhead, FarGapEnd::highest);
  for_high_.lower_borders.lower_to(for_high_.upper_borders);
  // The low count: the residual's high bound, and no gaps
  for_low_ = for_estimate_.upper_borders;
  residual_.raise_to_high(packet_, for_low_);
}

std::uint32_t RayEngine::in_gap(const OverhangHorizons& h, std::uint32_t azimuth, float slope) {
  const std::uint32_t in_far = h.far_lower_borders.below(azimuth, slope) & ~h.far_upper_borders.below(azimuth, slope);
  return h.grounded.below(azimuth, slope) & ~h.lower_borders.below(azimuth, slope) & ~in_far;
}

void RayEngine::trace_gaps() {
  gap_rays_.clear();
  const bool has_gaps = for_estimate_.lower_borders.exceeds(for_estimate_.grounded) != 0 ||
                        (wants_bounds_ && for_high_.lower_borders.exceeds(for_high_.grounded) != 0);
  if (!has_gaps) return;
  const PlacedScene scene = overhangs_.scene();
  const RayOrigins origins = origins_of(packet_, scene.scene_from_cell_m);
  for (std::uint32_t k = 0; k < directions_.size(); ++k) {
    look_for_stop(k);
    const float slope = directions_.slopes()[k];
    const std::uint32_t estimate = in_gap(for_estimate_, k, slope), high = wants_bounds_ ? in_gap(for_high_, k, slope) : 0U;
    const std::uint32_t wanted = estimate | high;
    if (wanted == 0) continue;
    const std::uint32_t free = wanted & ~scene.occluder.blocked(origins, directions_.direction(k), least_distance_m, wanted);
    if (free != 0) gap_rays_.push_back({k, free & estimate, free & high});
  }
}

}  // namespace farlod
