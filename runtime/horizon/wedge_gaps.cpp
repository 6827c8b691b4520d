// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_gaps.hpp"

#include <algorithm>
#include <cstddef>

#include "horizon/kernels.hpp"

namespace farlod {

std::span<const WedgeGaps::Sky> WedgeGaps::find(std::span<const Gap> gaps, const OverhangFacets& facets, const WedgeShape& shape,
                                                SkyWeight weight, const ReceiverPacket& receivers) {
  found_.clear();
  if (gaps.empty()) return found_;
  const OverhangFacets& sorted = in_sight_.among(facets);
  room_.resize(4 * (packet_lanes * sorted.batches().size() + 1));
  WedgeGapBlock block;
  while (!gaps.empty()) {
    const std::span of_block = gaps.first(size_of_block(gaps, azimuths_.size()));
    put(of_block, receivers, block);
    wedge_gap_kernels().find_certain({sorted.batches(), sorted.boxes()}, shape, weight == SkyWeight::solid_angle,
                                     room_.front().data(), block);
    for (std::size_t n = 0; n < of_block.size(); ++n) found_.push_back({block.open[n], block.hidden[n], block.most[n]});
    gaps = gaps.subspan(of_block.size());
  }
  return found_;
}

void WedgeGaps::put(std::span<const Gap> gaps, const ReceiverPacket& r, WedgeGapBlock& block) const {
  for (std::size_t n = 0; n < packet_lanes; ++n) {
    const Gap& gap = gaps[std::min(n, gaps.size() - 1)];
    block.eyes.set(n, r, gap.lane, azimuths_, gap.azimuth);
    block.from[n] = gap.from;
    block.to[n] = n < gaps.size() ? gap.to : gap.from;
    block.top[n] = gap.top;
    block.lid[n] = gap.lid;
    block.below[n] = gap.below;
  }
}

}  // namespace farlod
