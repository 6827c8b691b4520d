// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/canopy_sky.hpp"

#include <array>
#include <cmath>
#include <iterator>

#include "contract/expects.hpp"

namespace farlod {
namespace {

using Row = PacketHorizon::Row;
constexpr std::size_t lanes = ReceiverPacket::lanes;

bool all_look_straight_up(const ReceiverPacket& r) {
  bool all_do = true;
  for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
    all_do = all_do && r.normal_x[l] == 0.0F && r.normal_y[l] == 0.0F && r.normal_z[l] > 0.0F;
  return all_do;
}

/// As the kernels read them.
const float* data_of(const SkyProfile::Rows& rows) { return rows.empty() ? nullptr : rows.front().data(); }

SkyRows rows_of(const SkyProfile& profile) {
  return {data_of(profile.sky_from), data_of(profile.gap_from), data_of(profile.gap_to), data_of(profile.gap_share),
          data_of(profile.sky)};
}

Row filled(float value) {
  Row row;
  row.fill(value);
  return row;
}

/// Grows and never shrinks: what it holds is written before it is read.
template <class T>
void make_room(std::vector<T>& room, std::size_t size) {
  if (room.size() < size) room.resize(size + size / 2);
}

}  // namespace

CanopySky::CanopySky(const AzimuthSampling& azimuths, float range_m, const CrownTarget& kernels)
    : azimuths_(azimuths),
      range_square_(range_m * range_m),
      kernels_(kernels),
      ground_(azimuths.size()),
      lowest_ground_(azimuths.size()) {}

CanopyShares CanopySky::evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CrownBatches& crowns,
                                 std::span<Row> behind_of_azimuths) {
  FARLOD_EXPECTS(profile.sky_from.size() == azimuths_.size());
  FARLOD_EXPECTS(behind_of_azimuths.empty() || behind_of_azimuths.size() == azimuths_.size());
  std::ranges::fill(behind_of_azimuths, Row{});
  if (crowns.empty()) return {};
  const SkyRows sky = rows_of(profile);
  const CrownScene scene{crowns.batches(), &receivers, azimuths_.view(), range_square_, all_look_straight_up(receivers)};
  find_seen(sky, scene, crowns);
  if (seen_.empty()) return {};
  float* const of_azimuths = behind_of_azimuths.empty() ? nullptr : behind_of_azimuths.front().data();
  return crowns.rule() == CanopyRule::once ? by_smallest(sky, scene, crowns, of_azimuths)
                                           : by_depth(sky, scene, crowns.rule(), of_azimuths);
}

void CanopySky::find_seen(const SkyRows& sky, const CrownScene& scene, const CrownBatches& crowns) {
  float* const ground = ground_.front().data();
  kernels_.cover->find_ground(sky, scene, ground, lowest_ground_.data());
  seen_.resize(crowns.size());
  seen_.resize(kernels_.cover->find_seen(scene, bounds_of(*scene.receivers).box, ground, seen_.data()));
}

void CanopySky::sort_from_near_to_far() {
  // By rings of equal width, which is near enough, and linear
  constexpr std::size_t rings = 256;
  float farthest = 1.0F;
  for (const SeenCrown& s : drawn_) farthest = std::max(farthest, s.distance);
  const float per_distance = 0.999F * static_cast<float>(rings) / farthest;
  const auto ring_of = [&](const SeenCrown& s) { return static_cast<std::size_t>(s.distance * per_distance); };
  std::array<std::uint32_t, rings + 1> begins{};
  for (const SeenCrown& s : drawn_) ++begins[ring_of(s) + 1];
  for (std::size_t ring = 0; ring < rings; ++ring) begins[ring + 1] += begins[ring];
  by_distance_.resize(drawn_.size());
  for (const SeenCrown& s : drawn_) by_distance_[begins[ring_of(s)]++] = s;
}

std::size_t CanopySky::begin_lists() {
  // Each crown adds one from its first azimuth on, and takes it back at its end
  begins_.assign(azimuths_.size() + 1, 0);
  const auto size = static_cast<std::uint32_t>(azimuths_.size());
  std::uint32_t over_the_end = 0;
  for (const SeenCrown& s : drawn_) {
    const std::uint32_t end = s.first + s.count;
    ++begins_[s.first];
    --begins_[end < size ? end : end - size];
    if (end >= size) ++over_the_end;
  }
  std::uint32_t begin = 0, here = over_the_end;
  for (std::uint32_t& entry : begins_) {
    here += entry;
    entry = begin;
    begin += here + 1;
  }
  counts_.assign(azimuths_.size(), 0);
  return begin;
}

CanopySky::Lanes CanopySky::sky_behind(const SkyRows& sky, const CrownScene& scene, float most_transmissivity, float* rows) {
  drawn_.clear();
  for (const SeenCrown& s : seen_) {
    if (scene.batches[s.crown / lanes].transmissivity[s.crown % lanes] <= most_transmissivity) drawn_.push_back(s);
  }
  sort_from_near_to_far();
  const std::size_t room = begin_lists();
  make_room(low_, room);
  make_room(high_, room);
  // No core: it begins above all slopes, and ends below
  constexpr float none_low = 1e30F, none_high = -1.0F;
  risen_ground_ = ground_;
  core_low_.assign(azimuths_.size(), filled(none_low));
  core_high_.assign(azimuths_.size(), filled(none_high));
  // In each list, the first place is kept for it
  counts_.assign(azimuths_.size(), 1);
  const CoverRows covered{risen_ground_.front().data(),
                          core_low_.front().data(),
                          core_high_.front().data(),
                          begins_.data(),
                          counts_.data(),
                          low_.front().data(),
                          high_.front().data(),
                          rows};
  kernels_.cover->cover(scene, by_distance_, covered);
  Lanes behind;
  kernels_.cover->sum_covered(sky, scene, covered, behind.data());
  return behind;
}

CanopyShares CanopySky::by_smallest(const SkyRows& sky, const CrownScene& scene, const CrownBatches& crowns,
                                    float* behind_of_azimuths) {
  // 1 − ψ of all that is behind crowns, with the largest ψ, and the rest of what is behind crowns with the smallest
  const float least = crowns.least_transmissivity(), most = crowns.most_transmissivity();
  CanopyShares shares;
  shares.behind = sky_behind(sky, scene, most, behind_of_azimuths);
  for (std::size_t l = 0; l < shares.lost.size(); ++l) shares.lost[l] = (1.0F - most) * shares.behind[l];
  if (least == most) return shares;
  const Lanes behind_least = sky_behind(sky, scene, least, nullptr);
  for (std::size_t l = 0; l < shares.lost.size(); ++l) shares.lost[l] += (most - least) * behind_least[l];
  return shares;
}

CanopyShares CanopySky::by_depth(const SkyRows& sky, const CrownScene& scene, CanopyRule rule, float* behind_of_azimuths) {
  // In the order of the crowns, so that depths are added up in the same order for all packets
  drawn_ = seen_;
  const std::size_t room = begin_lists();
  make_room(sections_, room);
  make_room(section_crowns_, room);
  const SectionRows rows{lowest_ground_.data(), begins_.data(),         counts_.data(),
                         sections_.data(),      section_crowns_.data(), behind_of_azimuths};
  kernels_.light->cut(scene, drawn_, rows);
  // At most four ends of each section
  constexpr std::size_t most_ends = 4;
  make_room(ends_, most_ends * static_cast<std::size_t>(*std::max_element(counts_.begin(), counts_.end())) + 1);
  CrownSums sums;
  kernels_.light->sum_light(sky, scene, rows, rule, ends_.front().data(), sums);
  return {sums.lost, sums.behind};
}

}  // namespace farlod
