// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/gap_sections.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>

#include "horizon/kernels.hpp"

namespace farlod {
namespace {

/// Near facets close most gaps: so many boxes of batches come first, and then as many times more.
constexpr std::size_t first_boxes = 1, times_more = 4;

/// Merges two lists in the order of azimuths, the second of which begins at `middle`.
void merge(std::size_t middle, std::vector<OpenGap>& gaps) {
  const auto begin = gaps.begin();
  std::inplace_merge(begin, begin + static_cast<std::ptrdiff_t>(middle), gaps.end(),
                     [](const OpenGap& a, const OpenGap& b) { return a.azimuth < b.azimuth; });
}

/// The facets in these boxes.
FacetsInBoxes facets_between(const OverhangFacets& facets, std::size_t first, std::size_t end) {
  constexpr std::size_t lanes = OverhangFacets::lanes;
  const std::size_t end_batch = std::min(end * lanes, facets.batches().size());
  return {facets.batches().subspan(first * lanes, end_batch - first * lanes), facets.boxes().subspan(first, end - first)};
}

}  // namespace

GapSections::GapSections(const AzimuthSampling& azimuths) : azimuths_(azimuths), in_sight_(azimuths), of_packet_(azimuths) {}

void GapSections::begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> grounded) {
  in_sight_.begin(packets, grounded);
}

std::span<const OpenGap> GapSections::find_open(const OverhangFacets& facets, const Gaps& gaps, SkyWeight weight,
                                                const ReceiverPacket& receivers) {
  find_open_among(in_sight_.among(facets), gaps, weight, receivers);
  return open_;
}

std::span<const OpenGap> GapSections::find_any_open(const OverhangFacets& facets, const Gaps& gaps, SkyWeight weight,
                                                    const ReceiverPacket& receivers) {
  of_packet_.begin({&receivers, 1}, {&gaps.from, 1});
  find_open_among(of_packet_.among(facets), gaps, weight, receivers);
  return open_;
}

void GapSections::find_open_among(const OverhangFacets& sorted, const Gaps& gaps, SkyWeight weight,
                                  const ReceiverPacket& receivers) {
  collect(gaps);
  split_.clear();
  room_.resize(2 * (sorted.size() + 1));
  const std::size_t all = sorted.boxes().size();
  std::size_t known = 0, count = std::min(first_boxes, all);
  while (!open_.empty() || !split_.empty()) {
    left_.clear();
    left_split_.clear();
    // What known facets leave open, the ends of a gap tell, unless it is split
    narrow(open_, facets_between(sorted, known, count), weight, receivers);
    const std::size_t left = left_.size(), left_split = left_split_.size();
    narrow(split_, facets_between(sorted, 0, count), weight, receivers);
    merge(left, left_);
    merge(left_split, left_split_);
    std::swap(open_, left_);
    std::swap(split_, left_split_);
    if (count == all) break;
    known = count;
    count = std::min(count * times_more, all);
  }
  const std::size_t whole = open_.size();
  open_.insert(open_.end(), split_.begin(), split_.end());
  merge(whole, open_);
}

void GapSections::collect(const Gaps& gaps) {
  found_.resize(azimuths_.size());
  gap_kernels().find_gaps(gaps.sky.front().data(), azimuths_.size(), found_.data());
  open_.clear();
  for (std::uint32_t k = 0; k < azimuths_.size(); ++k)
    for (std::uint32_t bits = found_[k] & gaps.receivers; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::uint32_t>(std::countr_zero(bits));
      open_.push_back({k, l, gaps.from.row(k)[l], gaps.to.row(k)[l], gaps.hidden_from.row(k)[l], gaps.hidden_to.row(k)[l]});
    }
}

void GapSections::narrow(std::span<const OpenGap> gaps, const FacetsInBoxes& facets, SkyWeight weight,
                         const ReceiverPacket& receivers) {
  GapBlock block;
  while (!gaps.empty()) {
    const std::span of_block = gaps.first(size_of_block(gaps, azimuths_.size()));
    put(of_block, receivers, block);
    gap_kernels().find_open(facets, weight == SkyWeight::solid_angle, room_.front().data(), block);
    for (std::size_t n = 0; n < of_block.size(); ++n) {
      if (!(block.from[n] < block.to[n])) continue;
      OpenGap& gap = (block.is_split[n] != 0.0F ? left_split_ : left_).emplace_back(of_block[n]);
      gap.from = block.from[n];
      gap.to = block.to[n];
      gap.sky = block.sky[n];
      gap.is_split = block.is_split[n] != 0.0F;
    }
    gaps = gaps.subspan(of_block.size());
  }
}

void GapSections::put(std::span<const OpenGap> gaps, const ReceiverPacket& r, GapBlock& block) const {
  for (std::size_t n = 0; n < packet_lanes; ++n) {
    const OpenGap& gap = gaps[std::min(n, gaps.size() - 1)];
    block.eyes.set(n, r, gap.lane, azimuths_, gap.azimuth);
    block.from[n] = gap.from;
    block.to[n] = n < gaps.size() ? gap.to : gap.from;
    block.hidden_from[n] = gap.hidden_from;
    block.hidden_to[n] = gap.hidden_to;
  }
}

}  // namespace farlod
