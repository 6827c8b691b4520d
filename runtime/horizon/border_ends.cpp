// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/border_ends.hpp"

#include <bit>
#include <limits>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

/// Spreads the bits of a place: the factors are odd, and have no pattern in their bits.
std::uint32_t mixed(const Point3f& p) {
  std::uint32_t h = std::bit_cast<std::uint32_t>(p.x) * 0x9E3779B1U;
  h = (std::rotl(h, 13) ^ std::bit_cast<std::uint32_t>(p.y)) * 0x85EBCA77U;
  h = (std::rotl(h, 13) ^ std::bit_cast<std::uint32_t>(p.z)) * 0xC2B2AE3DU;
  return h ^ (h >> 15U);
}

}  // namespace

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
    std::size_t slot = mixed(ends_[n].p) & mask;
    while (table[slot] != none && ends_[table[slot]].p != ends_[n].p) slot = (slot + 1) & mask;
    if (table[slot] == none)
      table[slot] = n;
    else
      std::swap(ends_[n].next, ends_[table[slot]].next);
  }
}

}  // namespace farlod
