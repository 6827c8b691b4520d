// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/border_roles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/ground_contact.hpp"
#include "city/geometry.hpp"
#include "tiles/solid_to_ground.hpp"
#include "tiles/undersides.hpp"
#include "tiles/walled_in.hpp"

namespace farlod::tiles {
namespace {

bool stands_on_ground(const Slab& slab, const GroundHeightAt& ground_m) {
  const auto& [a, b, c] = slab.corners;
  const std::array places{a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
  return std::all_of(places.begin(), places.end(),
                     [&](const Point3d& p) { return p.z <= ground_m(horizontal(p)) + ground_contact_m; });
}

/// The stretch of `s` that lies right below `other`, on one line in the plan.
std::optional<ShareStretch> stretch_below(const Segment3d& s, const Segment3d& other) {
  const Point2d along = horizontal(s.b - s.a);
  const double square = dot(along, along), run_m = std::sqrt(square);
  const std::array from_begin{horizontal(other.a - s.a), horizontal(other.b - s.a)};
  for (const Point2d v : from_begin)
    if (std::abs(across(along, v)) > on_line_m * run_m) return std::nullopt;
  const std::array share{dot(along, from_begin[0]) / square, dot(along, from_begin[1]) / square};
  const auto [low, high] = std::minmax(share[0], share[1]);
  const ShareStretch shared{std::max(low, 0.0), std::min(high, 1.0)};
  if ((shared.to - shared.from) * run_m <= on_line_m) return std::nullopt;
  const auto is_below = [&](double at) {
    const double other_m = std::lerp(other.a.z, other.b.z, (at - share[0]) / (share[1] - share[0]));
    return std::lerp(s.a.z, s.b.z, at) < other_m - on_line_m;
  };
  return is_below(shared.from) && is_below(shared.to) ? std::optional(shared) : std::nullopt;
}

/// Segments, to find those on the line of one in the plan.
class SortedSegments {
 public:
  explicit SortedSegments(std::vector<Segment3d> segments) : segments_(std::move(segments)) {
    std::sort(segments_.begin(), segments_.end(), [](const Segment3d& a, const Segment3d& b) {
      return west_of(a) < west_of(b) || (west_of(a) == west_of(b) && comes_first(a.a, b.a));
    });
    for (const Segment3d& s : segments_) widest_m_ = std::max(widest_m_, std::max(s.a.x, s.b.x) - west_of(s));
  }
  template <class Visit>
  void visit_near(const Segment3d& s, const Visit& visit) const {
    const double east_m = std::max(s.a.x, s.b.x) + on_line_m;
    auto other = std::lower_bound(segments_.begin(), segments_.end(), west_of(s) - on_line_m - widest_m_,
                                  [](const Segment3d& t, double x) { return west_of(t) < x; });
    for (; other != segments_.end() && west_of(*other) <= east_m; ++other) visit(*other);
  }

 private:
  static double west_of(const Segment3d& s) { return std::min(s.a.x, s.b.x); }
  std::vector<Segment3d> segments_;
  double widest_m_ = 0.0;
};

/// Adds the stretches of a border as borders of this role. Its own ends stay exact: other borders begin there.
void add_parts(const HorizonSegment& border, const std::vector<ShareStretch>& stretches, EdgeRole role,
               std::vector<HorizonSegment>& result) {
  const Segment3d& s = border.segment;
  for (const ShareStretch& t : stretches)
    if ((t.from == 0.0 && t.to == 1.0) || (t.to - t.from) * norm(s.b - s.a) > on_line_m)
      result.push_back(
          {{t.from == 0.0 ? s.a : point_at(s, t.from), t.to == 1.0 ? s.b : point_at(s, t.to)}, border.adjacent, role});
}

std::vector<HorizonSegment> without_those_below_grounded(const std::vector<HorizonSegment>& borders) {
  std::vector<Segment3d> grounded;
  for (const HorizonSegment& border : borders)
    if (border.role == EdgeRole::grounded) grounded.push_back(border.segment);
  const SortedSegments hiding(std::move(grounded));
  std::vector<HorizonSegment> result;
  for (const HorizonSegment& border : borders) {
    std::vector<ShareStretch> seen{{}};
    hiding.visit_near(border.segment, [&](const Segment3d& other) {
      if (const auto hidden = stretch_below(border.segment, other)) seen = without(seen, *hidden);
    });
    add_parts(border, seen, border.role, result);
  }
  return result;
}

}  // namespace

std::vector<HorizonSegment> upper_borders_with_roles(BuildingPieces& building, const GroundHeightAt& ground_height) {
  const GroundedWalls walls(*std::exchange(building.walls, std::nullopt), ground_height);
  for (Slab& slab : building.slabs) slab.on_ground = stands_on_ground(slab, ground_height);
  // The inside of a closed building is known. Without slabs, nothing is: most buildings need none
  const bool is_closed = building.loose_edges.empty(), is_known = !building.slabs.empty();
  const SolidToGround solid(is_closed ? std::span<const Slab>(building.slabs) : std::span<const Slab>());
  const WalledIn walled_in(is_known ? walls.walls() : std::span<const WallProfile>(), building.slabs, building.loose_edges);
  const std::vector<ShareStretch> whole{{}};
  std::vector<HorizonSegment> result;
  for (HorizonSegment border : building.upper_borders) {
    if (walls.close_below(border.segment)) {
      // Only the wall is known to be grounded, not the roof behind it: the border faces all eyes
      border.adjacent = {};
      add_parts(border, whole, EdgeRole::grounded, result);
      continue;
    }
    auto [grounded, buried] = solid.parts_of(border.segment);
    const std::vector<ShareStretch> within = walled_in.stretches_of(border.segment);
    grounded.insert(grounded.end(), within.begin(), within.end());
    grounded = tidied(std::move(grounded), contact_m / norm(border.segment.b - border.segment.a));
    add_parts(border, without(grounded, buried), EdgeRole::grounded, result);
    add_parts(border, without(without(whole, grounded), buried), EdgeRole::overhang, result);
  }
  building.slabs = {};
  return without_those_below_grounded(result);
}

}  // namespace farlod::tiles
