// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/facets_in_sight.hpp"

#include <bit>
#include <cstddef>
#include <numeric>

namespace farlod {

void FacetsInSight::begin(std::span<const ReceiverPacket> packets, std::span<const PacketHorizon> horizons) {
  std::vector<PacketBounds> bounds;
  std::vector<const float*> slopes;
  for (const ReceiverPacket& packet : packets) bounds.push_back(bounds_of(packet));
  for (const PacketHorizon& horizon : horizons) slopes.push_back(horizon.slopes());
  bounds_ = joined(bounds);
  gap_kernels().find_lowest(slopes, azimuths_.view(), where_, lowest_);
  is_sorted_ = false;
}

const OverhangFacets& FacetsInSight::among(const OverhangFacets& facets) {
  if (!is_sorted_) sort(facets);
  is_sorted_ = true;
  return sorted_;
}

void FacetsInSight::sort(const OverhangFacets& facets) {
  const std::size_t batches = facets.batches().size();
  found_.resize(batches);
  gap_kernels().find_above({facets.batches(), facets.boxes()}, bounds_, lowest_, found_.data());
  bins_.resize(batches * OverhangFacets::lanes);
  gap_kernels().find_bins(facets.batches(), bounds_.box, found_.data(), bins_.data());
  // A counting sort: count each bin, sum up where each begins, and put each facet there
  const auto visit = [&](const auto& take) {
    for (std::size_t batch = 0; batch < batches; ++batch)
      for (std::uint32_t bits = found_[batch]; bits != 0; bits &= bits - 1) {
        const std::size_t n = batch * OverhangFacets::lanes + static_cast<std::size_t>(std::countr_zero(bits));
        if (n < facets.size()) take(n, static_cast<std::size_t>(bins_[n]));
      }
  };
  places_.assign(GapKernels::bins + 1, 0);
  visit([&](std::size_t, std::size_t bin) { ++places_[bin + 1]; });
  std::partial_sum(places_.begin(), places_.end(), places_.begin());
  order_.resize(places_.back());
  visit([&](std::size_t n, std::size_t bin) { order_[places_[bin]++] = static_cast<std::uint32_t>(n); });
  sorted_.clear();
  for (const std::uint32_t n : order_) sorted_.add(facets.at(n));
}

}  // namespace farlod
