// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/canopy_sky.hpp"

#include <optional>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

using Row = PacketHorizon::Row;

/// As the kernels read them.
const float* data_of(const SkyProfile::Rows& rows) { return rows.empty() ? nullptr : rows.front().data(); }

SkyRows rows_of(const SkyProfile& profile) {
  return {data_of(profile.sky_from), data_of(profile.gap_from), data_of(profile.gap_to), data_of(profile.gap_share),
          data_of(profile.sky)};
}

/// Grows and never shrinks: what it holds is written before it is read.
template <class T>
void make_room(std::vector<T>& room, std::size_t size) {
  if (room.size() < size) room.resize(size + size / 2);
}

/// The details of one packet, as kernels take them: it must outlive the rows.
class BehindOfPacket {
 public:
  BehindOfPacket(const CanopyDetails& details, const ReceiverPacket& receivers, float share)
      : behind_(details.behind_of_azimuths.empty() ? nullptr : details.behind_of_azimuths.front().data()) {
    if (!details.dimmed.empty()) keep_.emplace(KeepDimmed{details.dimmed.front(), share, receivers.lanes_in_use()});
  }
  [[nodiscard]] BehindRows rows() { return {behind_, keep_ ? keep_->taker() : DimmedTaker()}; }

 private:
  float* behind_;
  std::optional<KeepDimmed> keep_;
};

}  // namespace

CanopySky::CanopySky(const AzimuthSampling& azimuths, float range_m, const CrownTarget& kernels)
    : azimuths_(azimuths), range_square_(range_m * range_m), kernels_(kernels) {}

CanopyShares CanopySky::evaluate(const SkyProfile& profile, const ReceiverPacket& receivers, const CrownBatches& crowns,
                                 const CanopyDetails& details) {
  CanopyShares shares;
  evaluate({&profile, 1}, {&receivers, 1}, crowns, {&shares, 1}, details);
  return shares;
}

void CanopySky::evaluate(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                         const CrownBatches& crowns, std::span<CanopyShares> shares, const CanopyDetails& details) {
  FARLOD_EXPECTS(profiles.size() == packets.size() && shares.size() == packets.size());
  FARLOD_EXPECTS(details.behind_of_azimuths.empty() || details.behind_of_azimuths.size() == packets.size() * azimuths_.size());
  FARLOD_EXPECTS(details.dimmed.empty() || details.dimmed.size() == packets.size());
  std::ranges::fill(shares, CanopyShares{});
  std::ranges::fill(details.behind_of_azimuths, Row{});
  for (DimmedSky& dimmed : details.dimmed) dimmed.clear();
  if (crowns.empty() || packets.empty()) return;
  find_lowest_grounds(profiles, packets);
  find_in_sight(packets, crowns);
  if (in_sight_.empty()) return;
  for (std::size_t n = 0; n < packets.size(); ++n)
    shares[n] = evaluate(rows_of(profiles[n]), packets[n], lowest_grounds_[n].data(), details.of_packet(n, packets.size()));
}

CrownScene CanopySky::scene_of(const ReceiverPacket& receivers, const CrownBatches& crowns) const {
  return {crowns.batches(), &receivers, azimuths_.view(), range_square_, receivers.all_look_straight_up()};
}

void CanopySky::find_lowest_grounds(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets) {
  // Sixteen more than azimuths, that no crown rises above
  if (lowest_grounds_.size() < packets.size())
    lowest_grounds_.resize(packets.size(),
                           std::vector<float>(azimuths_.size() + ReceiverPacket::lanes, std::numeric_limits<float>::infinity()));
  for (std::size_t n = 0; n < packets.size(); ++n) {
    FARLOD_EXPECTS(profiles[n].sky_from.size() == azimuths_.size());
    kernels_.cover->find_lowest_ground(rows_of(profiles[n]), scene_of(packets[n], {}), lowest_grounds_[n].data());
  }
}

void CanopySky::find_in_sight(std::span<const ReceiverPacket> packets, const CrownBatches& crowns) {
  std::vector<PacketBounds> bounds;
  std::vector<const float*> lowest;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    bounds.push_back(bounds_of(packets[n]));
    lowest.push_back(lowest_grounds_[n].data());
  }
  find_seen(scene_of(packets.front(), crowns), joined(bounds).box, lowest);
  // The rule `once` is fastest from near to far. By the other rules, depths are added up in the same order for all packets
  if (crowns.rule() == CanopyRule::once) sort_from_near_to_far();
  numbers_.clear();
  for (const SeenCrown& s : seen_) numbers_.push_back(s.crown);
  in_sight_.assign(crowns, numbers_);
}

void CanopySky::find_seen(const CrownScene& scene, const CenteredBox& box, std::span<const float* const> lowest) {
  seen_.resize(scene.batches.size() * ReceiverPacket::lanes);
  seen_.resize(kernels_.cover->find_seen(scene, box, lowest, seen_.data()));
}

void CanopySky::sort_from_near_to_far() {
  std::ranges::sort(seen_, [](const SeenCrown& a, const SeenCrown& b) {
    return std::pair(a.distance, a.crown) < std::pair(b.distance, b.crown);
  });
}

CanopyShares CanopySky::evaluate(const SkyRows& sky, const ReceiverPacket& receivers, const float* lowest,
                                 const CanopyDetails& details) {
  const CrownScene scene = scene_of(receivers, in_sight_);
  find_seen(scene, bounds_of(receivers).box, {&lowest, 1});
  if (seen_.empty()) return {};
  return in_sight_.rule() == CanopyRule::once ? by_smallest(sky, scene, lowest, details) : by_depth(sky, scene, lowest, details);
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
    begin += here;
  }
  return begin;
}

CanopySky::Lanes CanopySky::sky_behind(const SkyRows& sky, const CrownScene& scene, const float* lowest,
                                       float most_transmissivity, const BehindRows& wanted) {
  drawn_.clear();
  for (const SeenCrown& s : seen_) {
    constexpr std::size_t lanes = ReceiverPacket::lanes;
    if (scene.batches[s.crown / lanes].transmissivity[s.crown % lanes] <= most_transmissivity) drawn_.push_back(s);
  }
  make_room(listed_, begin_lists());
  ends_.assign(begins_.begin(), begins_.end());
  const CrownLists lists{begins_.data(), ends_.data(), listed_.data()};
  drawn_.resize(kernels_.cover->list(drawn_, lowest, scene.azimuths.size, lists));
  make_room(placed_, drawn_.size());
  kernels_.cover->place(scene, drawn_, placed_.data());
  make_room(room_, 2 * drawn_.size() + 2);
  Lanes behind;
  kernels_.cover->sum_behind(sky, scene, lists, placed_.data(), room_.front().data(), wanted, behind.data());
  return behind;
}

CanopyShares CanopySky::by_smallest(const SkyRows& sky, const CrownScene& scene, const float* lowest,
                                    const CanopyDetails& details) {
  // 1 − ψ of all that is behind crowns, with the largest ψ, and the rest of what is behind crowns with the smallest
  const float least = in_sight_.least_transmissivity(), most = in_sight_.most_transmissivity();
  CanopyShares shares;
  shares.behind = sky_behind(sky, scene, lowest, most, BehindOfPacket(details, *scene.receivers, 1.0F - most).rows());
  for (std::size_t l = 0; l < shares.lost.size(); ++l) shares.lost[l] = (1.0F - most) * shares.behind[l];
  if (least == most) return shares;
  const CanopyDetails no_rows{{}, details.dimmed};
  const Lanes behind_least =
      sky_behind(sky, scene, lowest, least, BehindOfPacket(no_rows, *scene.receivers, most - least).rows());
  for (std::size_t l = 0; l < shares.lost.size(); ++l) shares.lost[l] += (most - least) * behind_least[l];
  return shares;
}

CanopyShares CanopySky::by_depth(const SkyRows& sky, const CrownScene& scene, const float* lowest, const CanopyDetails& details) {
  drawn_ = seen_;
  const std::size_t room = begin_lists();
  counts_.assign(azimuths_.size(), 0);
  make_room(sections_, room);
  make_room(listed_, room);
  BehindOfPacket wanted(details, *scene.receivers, 1.0F);
  const SectionRows rows{lowest,         begins_.data(),       counts_.data(),      sections_.data(),
                         listed_.data(), wanted.rows().behind, wanted.rows().dimmed};
  kernels_.light->cut(scene, drawn_, rows);
  // At most four ends of each section
  constexpr std::size_t most_ends = 4;
  make_room(room_, most_ends * static_cast<std::size_t>(*std::ranges::max_element(counts_)) + 1);
  CrownSums sums;
  kernels_.light->sum_light(sky, scene, rows, in_sight_.rule(), room_.front().data(), sums);
  return {sums.lost, sums.behind};
}

}  // namespace farlod
