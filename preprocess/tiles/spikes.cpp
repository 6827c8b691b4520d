// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/spikes.hpp"

#include <algorithm>
#include <iterator>
#include <list>

namespace farlod::tiles {
namespace {

struct Corner {
  Point3d p;
  std::size_t number = 0;
};

/// Length of the spike at `tip` between its neighbors; 0 when there is none.
double length_of_spike_m(const Point3d& before, const Point3d& tip, const Point3d& after) {
  const Point3d there = before - tip, back = after - tip;
  if (dot(there, back) <= 0.0) return 0.0;  // nearly all corners of buildings
  const double longer = std::max(norm(there), norm(back)), shorter = std::min(norm(there), norm(back));
  if (shorter < least_spike_m) return 0.0;
  return norm(cross(there, back)) <= spike_width_m * longer ? shorter : 0.0;
}

class Despiking {
 public:
  explicit Despiking(std::span<const Point3d> ring) {
    for (const Point3d& p : ring) corners_.push_back({p, corners_.size()});
  }

  DespikedRing run() {
    // The removal of a tip may turn a neighbor into the next tip: step back after each removal, and end when a whole round is
    // clean
    std::size_t clean = 0;
    for (auto corner = corners_.begin(); corners_.size() >= 3 && clean < corners_.size();) {
      const double length_m = length_of_spike_m(before(corner)->p, corner->p, after(corner)->p);
      if (length_m == 0.0) {
        corner = after(corner);
        ++clean;
        continue;
      }
      spikes_.push_back({corner->number, corner->p, length_m});
      corner = remove(corner);
      // Both corners beside the removed tip have a new neighbor: test them again
      clean = std::min(clean - std::min<std::size_t>(clean, 1), corners_.size() - 2);
    }
    DespikedRing result{{}, std::move(spikes_)};
    for (const Corner& corner : corners_) result.ring.push_back(corner.p);
    return result;
  }

 private:
  using Place = std::list<Corner>::iterator;

  Place before(Place corner) { return std::prev(corner == corners_.begin() ? corners_.end() : corner); }
  Place after(Place corner) { return std::next(corner) == corners_.end() ? corners_.begin() : std::next(corner); }

  /// Removes a tip, and the corner after it when that equals the corner before the tip. Returns the corner before.
  Place remove(Place tip) {
    const Place left = before(tip), right = after(tip);
    const bool is_shut = norm(left->p - right->p) <= spike_width_m;
    corners_.erase(tip);
    if (is_shut) corners_.erase(right);
    return left;
  }

  std::list<Corner> corners_;  // of which any may go at any time
  std::vector<Spike> spikes_;
};

bool has_spike(std::span<const Point3d> ring) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k)
    if (length_of_spike_m(ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]) > 0.0) return true;
  return false;
}

}  // namespace

std::optional<DespikedRing> without_spikes(std::span<const Point3d> ring) {
  // A triangle is never changed: nothing would remain of the slivers of a mesh
  if (ring.size() <= 3 || !has_spike(ring)) return std::nullopt;
  DespikedRing despiked = Despiking(ring).run();
  if (despiked.ring.size() < 3) return std::nullopt;
  return despiked;
}

}  // namespace farlod::tiles
