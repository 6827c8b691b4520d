// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/model_builder/ring_cleaning.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace farlod::ingest
