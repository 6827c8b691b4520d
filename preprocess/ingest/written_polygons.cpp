// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/written_polygons.hpp"

#include <algorithm>
#include <bit>
#include <span>

namespace farlod {
namespace {

/// Spreads the bits of a number over all of it (the finalizer of MurmurHash3).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

std::uint64_t hash_of(const Point3d& p) {
  // Adding zero makes the two zeros one
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(p.x + 0.0));
  hash = mixed(hash ^ std::bit_cast<std::uint64_t>(p.y + 0.0));
  return mixed(hash + std::bit_cast<std::uint64_t>(p.z + 0.0));
}

/// A sum over directed edges: it does not matter where the ring begins, but which way round it runs. Equal rings of two parts
/// differ by their parts, hence never meet.
std::uint64_t hash_of(const Rings& rings, std::uint16_t part) {
  std::uint64_t sum = part;
  for (const Ring& ring : rings) {
    std::uint64_t before = ring.empty() ? 0 : hash_of(ring.back());
    for (const Point3d& p : ring) {
      const std::uint64_t here = hash_of(p);
      sum += mixed(before + 3 * here);
      before = here;
    }
  }
  return sum;
}

bool are_same(std::span<const Point3d> a, std::span<const Point3d> b) {
  if (a.size() != b.size()) return false;
  for (std::size_t shift = 0; shift < a.size(); ++shift)
    if (std::equal(a.begin(), a.end() - static_cast<std::ptrdiff_t>(shift), b.begin() + static_cast<std::ptrdiff_t>(shift)) &&
        std::equal(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(shift), a.end() - static_cast<std::ptrdiff_t>(shift)))
      return true;
  return a.empty();
}

bool are_same(const CityModel& city, const Facet& facet, const Rings& rings) {
  if (facet.ring_count != rings.size()) return false;
  for (std::uint32_t k = 0; k < facet.ring_count; ++k)
    if (!are_same(city.ring(facet, k), rings[k])) return false;
  return true;
}

}  // namespace

std::optional<std::uint64_t> WrittenPolygons::find_or_remember(const CityModel& city, const Rings& rings, std::uint16_t part) {
  const std::uint64_t hash = hash_of(rings, part);
  const auto [first, last] = facets_by_hash_.equal_range(hash);
  for (auto entry = first; entry != last; ++entry)
    if (are_same(city, city.facets()[entry->second], rings)) return entry->second;
  facets_by_hash_.emplace(hash, city.facets().size());
  return std::nullopt;
}

}  // namespace farlod
