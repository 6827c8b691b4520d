// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/model_builder/ring_cleaning.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "city/geometry.hpp"

namespace farlod::ingest {
namespace {

bool is_readable(double coordinate) { return std::abs(coordinate) <= farthest_coordinate; }  // false for NaN

bool has_three_different(const Ring& ring) {
  return ring.size() >= 3 &&
         std::any_of(ring.begin() + 2, ring.end(), [&](const Point3d& p) { return p != ring[0] && p != ring[1]; });
}

}  // namespace

bool is_readable(const Point3d& p) { return is_readable(p.x) && is_readable(p.y) && is_readable(p.z); }

std::optional<Point3d> first_readable(std::span<const Ring> rings) {
  for (const Ring& ring : rings)
    for (const Point3d& p : ring)
      if (is_readable(p)) return p;
  return std::nullopt;
}

RingFindings clean_ring(Ring& ring, RingEnd end) {
  RingFindings findings;
  if (!std::all_of(ring.begin(), ring.end(), [](const Point3d& p) { return is_readable(p); })) {
    findings.state = RingState::unreadable_coordinate;
    return findings;
  }
  // Remove the closing point. Its absence is a defect only in formats that require it
  if (end == RingEnd::repeats_first && ring.size() > 1) {
    findings.was_open = ring.front() != ring.back();
    if (findings.was_open)
      findings.gap = norm(ring.back() - ring.front());
    else
      ring.pop_back();
  }
  const std::size_t before = ring.size();
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  findings.repeated_vertices = before - ring.size();
  if (!has_three_different(ring)) findings.state = RingState::too_few_points;
  return findings;
}

namespace {

using RingSpans = std::vector<std::span<const Point3d>>;

/// The finalizer of MurmurHash3: each bit of the number affects each bit of the result.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

std::uint64_t hash_of_point(double x, double y, double z) {
  // −0 + 0 is +0: the two zeros are equal coordinates
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(x + 0.0));
  hash = mixed(hash ^ std::bit_cast<std::uint64_t>(y + 0.0));
  return mixed(hash + std::bit_cast<std::uint64_t>(z + 0.0));
}

std::uint64_t hash_of_point(const Point3d& p) { return hash_of_point(p.x, p.y, p.z); }

/// A sum over the directed edges: it depends on the direction of a ring, and not on its first point.
std::uint64_t hash_of_rings(const Rings& rings) {
  std::uint64_t sum = 0;
  for (const Ring& ring : rings) {
    std::uint64_t before = ring.empty() ? 0 : hash_of_point(ring.back());
    for (const Point3d& p : ring) {
      const std::uint64_t here = hash_of_point(p);
      sum += mixed(before + 3 * here);
      before = here;
    }
  }
  return sum;
}

bool have_same_rings(const RingSpans& a, const Rings& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](std::span<const Point3d> p, const Ring& q) { return is_rotation_of(p, q); });
}

using Corner = std::array<double, 3>;

/// The distinct corners in ascending order. They are the same for a ring that repeats its first point or begins at another one.
template <class RingList>
std::vector<Corner> corners_of(const RingList& rings) {
  // NaN has no place in an order
  const auto ordered = [](double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x; };
  std::vector<Corner> corners;
  for (const auto& ring : rings)
    for (const Point3d& p : ring) corners.push_back({ordered(p.x), ordered(p.y), ordered(p.z)});
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::uint64_t hash_of_corners(const Rings& rings) {
  std::uint64_t hash = 0;
  for (const auto& [x, y, z] : corners_of(rings)) hash = mixed(hash + hash_of_point(x, y, z));
  return hash;
}

}  // namespace

std::vector<std::span<const Point3d>> spans_of(const Rings& rings) { return {rings.begin(), rings.end()}; }

std::uint64_t PolygonDeduplicator::hash_of(const Rings& rings, std::uint16_t part) const {
  // Thousands of parts may each have a copy of one polygon, and must not look through those of all others
  const std::uint64_t of_rings = criterion_ == SamePolygon::corners ? hash_of_corners(rings) : hash_of_rings(rings);
  return mixed(of_rings + part);
}

std::optional<std::uint64_t> PolygonDeduplicator::find_hashed(std::uint64_t hash, const Rings& rings, std::uint16_t part,
                                                              const PolygonAt& polygon_at) const {
  const auto [first, last] = entries_by_hash_.equal_range(hash);
  for (auto entry = first; entry != last; ++entry) {
    const auto& [number, part_of_entry] = entry->second;
    if (part_of_entry != part) continue;
    const RingSpans other = polygon_at(number);
    const bool is_same =
        criterion_ == SamePolygon::corners ? corners_of(other) == corners_of(rings) : have_same_rings(other, rings);
    if (is_same) return number;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> PolygonDeduplicator::find(const Rings& rings, std::uint16_t part,
                                                       const PolygonAt& polygon_at) const {
  return find_hashed(hash_of(rings, part), rings, part, polygon_at);
}

std::optional<std::uint64_t> PolygonDeduplicator::find_or_insert(const Rings& rings, std::uint16_t part, std::uint64_t number,
                                                                 const PolygonAt& polygon_at) {
  const std::uint64_t hash = hash_of(rings, part);
  if (auto same = find_hashed(hash, rings, part, polygon_at)) return same;
  entries_by_hash_.emplace(hash, Entry{number, part});
  return std::nullopt;
}

}  // namespace farlod::ingest
