// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/horizon_packets.hpp"

#include <algorithm>

#include "evaluate/visibility.hpp"
#include "farlod/expects.hpp"

namespace farlod {
namespace {

std::vector<Point3d> in_order(const AzimuthFan& fan, const std::vector<Point3d>& directions) {
  std::vector<Point3d> ordered;
  for (const std::uint32_t n : fan.place()) ordered.push_back(directions[n]);
  return ordered;
}

}  // namespace

HorizonPackets::HorizonPackets(const FarHorizon& far, const Occluder& near, std::vector<Point3d> directions, bool wants_bounds)
    : near_(near), wants_bounds_(wants_bounds), fan_(directions), view_(fan_, far) {
  directions_ = in_order(fan_, directions);
}

std::vector<FreeRays> HorizonPackets::count(std::span<const Point3f> origins) {
  origin_count_ = origins.size();
  verdicts_.resize(fan_.size() * origin_count_);
  std::vector<FarVerdict> of_one(fan_.size());
  for (std::size_t n = 0; n < origins.size(); ++n) {
    view_.judge(origins[n], of_one);
    for (std::size_t d = 0; d < fan_.size(); ++d) verdict(d, n) = of_one[d];
  }
  const FarVerdict last_wanted = wants_bounds_ ? FarVerdict::likely_blocked : FarVerdict::likely_free;
  wanted_.resize(verdicts_.size());
  free_.resize(verdicts_.size());
  std::transform(verdicts_.begin(), verdicts_.end(), wanted_.begin(),
                 [last_wanted](FarVerdict v) { return static_cast<std::uint8_t>(v <= last_wanted); });
  find_free(near_, origins, directions_, wanted_, free_);
  std::vector<FreeRays> result(origins.size());
  for (std::size_t d = 0; d < fan_.size(); ++d)
    for (std::size_t n = 0; n < origins.size(); ++n) {
      if (free_[d * origin_count_ + n] == 0) continue;
      const FarVerdict v = verdict(d, n);
      result[n].low += v == FarVerdict::free ? 1U : 0U;
      result[n].likely += v <= FarVerdict::likely_free ? 1U : 0U;
      result[n].high += 1;
    }
  if (!wants_bounds_)
    for (FreeRays& f : result) f.low = f.high = f.likely;
  return result;
}

std::uint64_t HorizonPackets::settle(const Occluder& city, std::span<const Point3f> origins, const std::vector<bool>& doubtful,
                                     std::vector<FreeRays>& free) {
  FARLOD_EXPECTS(wants_bounds_ && origins.size() == origin_count_ && doubtful.size() == origin_count_);
  std::uint64_t rays = 0;
  for (std::size_t place = 0; place < verdicts_.size(); ++place) {
    const bool open = verdicts_[place] == FarVerdict::likely_free || verdicts_[place] == FarVerdict::likely_blocked;
    wanted_[place] = static_cast<std::uint8_t>(open && free_[place] != 0 && doubtful[place % origin_count_]);
    rays += wanted_[place];
  }
  find_free(city, origins, directions_, wanted_, free_);
  for (std::size_t n = 0; n < origin_count_; ++n)
    if (doubtful[n]) free[n].high = free[n].low;
  for (std::size_t place = 0; place < free_.size(); ++place) free[place % origin_count_].high += free_[place];
  for (std::size_t n = 0; n < origin_count_; ++n)
    if (doubtful[n]) free[n].low = free[n].likely = free[n].high;
  return rays;
}

}  // namespace farlod
