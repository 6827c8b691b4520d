// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/silhouette_edges.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "base/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

/// A coarse order by distance is enough: 32 steps from each distance to its double, from 0.25 m to 130 km. The bits of a float
/// above the 18 lowest are its exponent and 5 bits of its fraction: they count these steps.
constexpr std::uint32_t step_bits = 18, step_count = 19 * 32, nearest_step = std::bit_cast<std::uint32_t>(0.25F) >> step_bits;

std::size_t step_of(float distance_m) {
  const std::uint32_t step = std::bit_cast<std::uint32_t>(distance_m) >> step_bits;
  return std::min(std::max(step, nearest_step) - nearest_step, step_count - 1);
}

CenteredBox centered(const ReceiverBox& b) {
  const float x = 0.5F * (b.low.x + b.high.x), y = 0.5F * (b.low.y + b.high.y);
  return {x, y, std::max(b.high.x - x, x - b.low.x), std::max(b.high.y - y, y - b.low.y), b.low.z, b.high.z};
}

/// A counting sort: the numbers of the distances ≥ 0, from near to far by steps, and in their order within a step.
std::vector<std::uint32_t> from_near_to_far(std::span<const float> distances_m) {
  std::vector<std::uint32_t> place_of_step(step_count + 1);
  // Count each step, sum up where each begins, and put each number there
  for (const float d : distances_m)
    if (d >= 0.0F) ++place_of_step[step_of(d) + 1];
  for (std::size_t step = 0; step < step_count; ++step) place_of_step[step + 1] += place_of_step[step];
  std::vector<std::uint32_t> order(place_of_step.back());
  for (std::size_t n = 0; n < distances_m.size(); ++n)
    if (distances_m[n] >= 0.0F) order[place_of_step[step_of(distances_m[n])]++] = static_cast<std::uint32_t>(n);
  return order;
}

/// Spreads the bits of a place: the factors are odd, and have no pattern in their bits.
std::uint32_t mixed(const Point3f& p) {
  std::uint32_t h = std::bit_cast<std::uint32_t>(p.x) * 0x9E3779B1U;
  h = (std::rotl(h, 13) ^ std::bit_cast<std::uint32_t>(p.y)) * 0x85EBCA77U;
  h = (std::rotl(h, 13) ^ std::bit_cast<std::uint32_t>(p.z)) * 0xC2B2AE3DU;
  return h ^ (h >> 15U);
}

}  // namespace

SilhouetteEdges SilhouetteEdges::facing(const ReceiverBox& box) const {
  std::vector<float> distances_m(batches_.size() * lanes);
  edge_kernels().find_facing({batches_, role_}, centered(box), distances_m.data());
  const std::vector<std::uint32_t> order = from_near_to_far(std::span(distances_m).first(size()));
  SilhouetteEdges result(role_);
  result.batches_.resize((order.size() + lanes - 1) / lanes);
  result.adjacent_.resize(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    result.batches_[n / lanes].copy_lane(n % lanes, batches_[order[n] / lanes], order[n] % lanes);
    result.adjacent_[n] = adjacent_[order[n]];
  }
  result.number_from(0);
  return result;
}

void SilhouetteEdges::assign(const SilhouetteEdges& edges, std::span<const std::uint16_t> chosen) {
  role_ = edges.role_;
  batches_.clear();
  adjacent_.clear();
  for (std::size_t batch = 0; batch < chosen.size(); ++batch)
    for (std::uint32_t bits = chosen[batch]; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if (batch * lanes + lane >= edges.size()) break;
      if (size() % lanes == 0) batches_.emplace_back();
      batches_.back().copy_lane(size() % lanes, edges.batches_[batch], lane);
      adjacent_.push_back(edges.adjacent_[batch * lanes + lane]);
    }
}

BorderEnds::BorderEnds(std::span<const SilhouetteEdges* const> lists) {
  for (const SilhouetteEdges* edges : lists) {
    FARLOD_EXPECTS(edges->empty() || edges->number(0) == static_cast<std::int32_t>(ends_.size() / 2));
    for (std::size_t n = 0; n < edges->size(); ++n) {
      const HorizonEdge e = edges->at(n);
      ends_.push_back({e.a});
      ends_.push_back({e.b});
    }
  }
  join_places();
}

void BorderEnds::join_places() {
  // A hash table of one end for each place, found by looking on from where its hash leads
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> table(std::bit_ceil(2 * ends_.size() + 1), none);
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t n = 0; n < ends_.size(); ++n) {
    ends_[n].next = n;
    places_.push_back(n);
    std::size_t slot = mixed(ends_[n].p) & mask;
    while (table[slot] != none && ends_[table[slot]].p != ends_[n].p) slot = (slot + 1) & mask;
    if (table[slot] == none) table[slot] = n;
    // A swap with itself leaves the first one alone
    std::swap(ends_[n].next, ends_[table[slot]].next);
    places_[n] = table[slot];
  }
}

}  // namespace farlod
