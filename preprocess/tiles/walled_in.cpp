// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/walled_in.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "city/geometry.hpp"
#include "tiles/contacts.hpp"
#include "tiles/solid_to_ground.hpp"

namespace farlod::tiles {
namespace {

/// What is so near to a wall in the plan is on it: more than coordinates are rounded by. What sticks out farther is seen from
/// below past the end of the wall.
constexpr double on_wall_m = least_sliver_m;

/// Whether a slab passes over a wall, higher than a contact above its upper border.
bool passes_over(const Slab& slab, const WallProfile& wall) {
  const auto stretch = part_within(slab, wall.place(0.0), wall.place(wall.length_m));
  if (!stretch) return false;
  // Both are straight between the points of the border
  const double from_m = stretch->from * wall.length_m, to_m = stretch->to * wall.length_m;
  const auto is_above = [&](double along_m) { return slab.height_m(wall.place(along_m)) > wall.upper_m(along_m) + contact_m; };
  return is_above(from_m) || is_above(to_m) || std::any_of(wall.upper.begin(), wall.upper.end(), [&](const WallPoint& p) {
           return p.along_m > from_m && p.along_m < to_m && is_above(p.along_m);
         });
}

}  // namespace

WalledIn::WalledIn(std::span<const WallProfile> walls, std::span<const Slab> slabs, std::span<const Segment3d> loose_edges) {
  for (const WallProfile& wall : walls) add(wall);
  const bool stand = form_rings() && std::none_of(walls.begin(), walls.end(), [&](const WallProfile& wall) {
                       return std::any_of(slabs.begin(), slabs.end(), [&](const Slab& slab) { return passes_over(slab, wall); });
                     });
  const auto hangs_within = [this](const Slab& slab) {
    if (slab.look == FacetLook::up || slab.on_ground) return false;
    Box2d plan;
    for (const Point3d& p : slab.corners) plan.add(horizontal(p));
    return boxes_meet(plan, box_);
  };
  const auto ends_within = [this](const Segment3d& edge) {
    const Point2d a = horizontal(edge.a), b = horizontal(edge.b);
    // A stretch within that is on no wall: looked at in the middle of each
    const std::vector<ShareStretch> within = stretches_of(edge);
    return std::any_of(within.begin(), within.end(),
                       [&](const ShareStretch& s) { return distance_m(a + 0.5 * (s.from + s.to) * (b - a)) > contact_m; });
  };
  if (!stand || std::any_of(slabs.begin(), slabs.end(), hangs_within) ||
      std::any_of(loose_edges.begin(), loose_edges.end(), ends_within))
    sides_.clear();
}

/// Walls that stand on each other are one side of the plan.
void WalledIn::add(const WallProfile& wall) {
  const Side side{corner_at(wall.place(0.0)), corner_at(wall.place(wall.length_m))};
  const auto is_same = [&](const Side& s) { return (s.a == side.a && s.b == side.b) || (s.a == side.b && s.b == side.a); };
  if (side.a == side.b || std::any_of(sides_.begin(), sides_.end(), is_same)) return;
  sides_.push_back(side);
  box_.add(side.a);
  box_.add(side.b);
}

/// The corner that is there already, or the place itself: between walls that meet, no line passes.
Point2d WalledIn::corner_at(Point2d p) const {
  for (const Side& s : sides_)
    for (const Point2d corner : {s.a, s.b})
      if (norm(corner - p) <= contact_m) return corner;
  return p;
}

/// Each corner is of an even number of walls.
bool WalledIn::form_rings() const {
  const auto is_of_even = [&](Point2d p) {
    std::size_t count = 0;
    for (const Side& side : sides_) count += (side.a == p ? 1U : 0U) + (side.b == p ? 1U : 0U);
    return count % 2 == 0;
  };
  return !sides_.empty() &&
         std::all_of(sides_.begin(), sides_.end(), [&](const Side& s) { return is_of_even(s.a) && is_of_even(s.b); });
}

/// By the even-odd rule.
bool WalledIn::holds(Point2d p) const {
  bool is_inside = false;
  for (const Side& s : sides_)
    if ((s.a.y > p.y) != (s.b.y > p.y) && p.x < s.a.x + (p.y - s.a.y) / (s.b.y - s.a.y) * (s.b.x - s.a.x)) is_inside = !is_inside;
  return is_inside;
}

double WalledIn::distance_m(Point2d p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Side& s : sides_) {
    const Point2d along = s.b - s.a;
    const double share = std::clamp(dot(p - s.a, along) / dot(along, along), 0.0, 1.0);
    least = std::min(least, norm(p - (s.a + share * along)));
  }
  return least;
}

std::vector<ShareStretch> WalledIn::stretches_of(const Segment3d& segment) const {
  const Point2d a = horizontal(segment.a), along = horizontal(segment.b - segment.a);
  const double run_m = norm(along);
  Box2d plan;
  plan.add(a);
  plan.add(a + along);
  if (sides_.empty() || run_m <= contact_m || !boxes_meet(plan, box_)) return {};
  // Where it crosses a wall, and where it leaves the line of one
  std::vector<double> places{0.0, 1.0};
  for (const Side& s : sides_) {
    const Point2d side = s.b - s.a;
    if (const double turn = across(along, side); turn != 0.0)
      places.push_back(std::clamp(across(s.a - a, side) / turn, 0.0, 1.0));
    for (const Point2d end : {s.a, s.b}) places.push_back(std::clamp(dot(end - a, along) / (run_m * run_m), 0.0, 1.0));
  }
  std::sort(places.begin(), places.end());
  std::vector<ShareStretch> within;
  for (std::size_t n = 1; n < places.size(); ++n) {
    const Point2d middle = a + 0.5 * (places[n - 1] + places[n]) * along;
    if (places[n] > places[n - 1] && (holds(middle) || distance_m(middle) <= on_wall_m))
      within.push_back({places[n - 1], places[n]});
  }
  return tidied(std::move(within), on_wall_m / run_m);
}

}  // namespace farlod::tiles
