// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/undersides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "city/geometry.hpp"

namespace farlod::tiles {
namespace {

/// A facet is vertical when all its points lie within this distance of a line in plan.
constexpr double upright_offset_m = 0.03;

/// Index of the point of the ring that is farthest from `p` in plan.
std::size_t farthest_from(Point2d p, std::span<const Point3d> ring) {
  const auto distance = [&](const Point3d& q) { return norm(horizontal(q) - p); };
  return static_cast<std::size_t>(
      std::max_element(ring.begin(), ring.end(), [&](const Point3d& a, const Point3d& b) { return distance(a) < distance(b); }) -
      ring.begin());
}

/// The points of a ring from index `from` to index `to`, in steps of `step`.
std::vector<WallPoint> chain(std::span<const WallPoint> ring, std::size_t from, std::size_t to, std::size_t step) {
  std::vector<WallPoint> points{ring[from]};
  for (std::size_t n = from; n != to; points.push_back(ring[n])) n = (n + step) % ring.size();
  return points;
}

/// Whether the points are sorted along the wall, up to the tolerance.
bool ascends(std::span<const WallPoint> border) {
  return std::is_sorted(border.begin(), border.end(),
                        [](const WallPoint& a, const WallPoint& b) { return a.along_m < b.along_m - on_line_m; });
}

/// Mean height of a border, weighted by length.
double mean_height(std::span<const WallPoint> border) {
  double area = 0.0, length = 0.0;
  for (std::size_t n = 1; n < border.size(); ++n) {
    const double step = border[n].along_m - border[n - 1].along_m;
    area += 0.5 * step * (border[n].z_m + border[n - 1].z_m);
    length += step;
  }
  return length > 0.0 ? area / length : border.front().z_m;
}

/// The vertical edges at both ends of a wall belong to neither border. Of the points at an end, keeps the outermost one.
template <class IsFarther>
std::vector<WallPoint> without_ends(std::vector<WallPoint> border, const IsFarther& is_farther) {
  const auto keep_outermost = [&](auto begin, auto end) {
    const double end_m = begin->along_m;
    auto beyond = std::find_if(begin, end, [&](const WallPoint& p) { return std::abs(p.along_m - end_m) > on_line_m; });
    return std::max_element(begin, beyond, [&](const WallPoint& a, const WallPoint& b) { return is_farther(b.z_m, a.z_m); });
  };
  border.erase(border.begin(), keep_outermost(border.begin(), border.end()));
  border.erase(keep_outermost(border.rbegin(), border.rend()).base(), border.end());
  return border;
}

/// The height of a border at a place. `choose` selects between the two heights of a step.
template <class Choose>
double height_at(std::span<const WallPoint> border, double along_m, const Choose& choose) {
  std::optional<double> height_m;
  const auto take = [&](double z_m) { height_m = height_m ? choose(*height_m, z_m) : z_m; };
  for (std::size_t n = 1; n < border.size(); ++n) {
    const WallPoint &a = border[n - 1], &b = border[n];
    if (along_m < a.along_m - on_line_m || along_m > b.along_m + on_line_m) continue;
    if (b.along_m - a.along_m <= on_line_m) {
      take(choose(a.z_m, b.z_m));
    } else {
      take(std::lerp(a.z_m, b.z_m, std::clamp((along_m - a.along_m) / (b.along_m - a.along_m), 0.0, 1.0)));
    }
  }
  return height_m.value_or(border.front().z_m);
}

/// Places along a wall at which its lower border is compared with the ground: the points of the border, and places between them
/// that are no farther apart than the sampling step.
std::vector<double> places_along(std::span<const WallPoint> border) {
  std::vector<double> places;
  for (std::size_t n = 1; n < border.size(); ++n) {
    const double from = border[n - 1].along_m, to = border[n].along_m;
    const int intervals = ground_sampling_intervals(to - from);
    for (int k = 0; k <= intervals; ++k) places.push_back(std::lerp(from, to, static_cast<double>(k) / intervals));
  }
  return places;
}

}  // namespace

double WallProfile::lower_m(double along_m) const {
  return height_at(lower, along_m, [](double a, double b) { return std::max(a, b); });
}

double WallProfile::upper_m(double along_m) const {
  return height_at(upper, along_m, [](double a, double b) { return std::min(a, b); });
}

std::optional<WallProfile> wall_profile(std::span<const Point3d> ring) {
  if (ring.size() < 3) return std::nullopt;
  // The line of the wall runs between the two points that are farthest from each other in plan
  const Point2d begin = horizontal(ring[farthest_from(horizontal(ring.front()), ring)]);
  const Point2d along = horizontal(ring[farthest_from(begin, ring)]) - begin;
  WallProfile wall{begin, {}, norm(along), {}, {}};
  if (wall.length_m <= on_line_m) return std::nullopt;
  wall.direction = (1.0 / wall.length_m) * along;
  // Express the ring along that line. The facet is not vertical when a point is too far from the line
  std::vector<WallPoint> points;
  for (const Point3d& p : ring) {
    const Point2d from_begin = horizontal(p) - begin;
    if (std::abs(across(wall.direction, from_begin)) > upright_offset_m) return std::nullopt;
    points.push_back({dot(wall.direction, from_begin), p.z});
  }
  // Split the ring at its first and its last point into two borders
  const auto before = [](const WallPoint& a, const WallPoint& b) { return a.along_m < b.along_m; };
  const auto [first, last] = std::minmax_element(points.begin(), points.end(), before);
  const auto from = static_cast<std::size_t>(first - points.begin()), to = static_cast<std::size_t>(last - points.begin());
  wall.lower = chain(points, from, to, 1);
  wall.upper = chain(points, from, to, points.size() - 1);
  // A border that turns back would let a vertical line meet the facet in several pieces
  if (!ascends(wall.lower) || !ascends(wall.upper)) return std::nullopt;
  if (mean_height(wall.lower) > mean_height(wall.upper)) std::swap(wall.lower, wall.upper);
  wall.lower = without_ends(std::move(wall.lower), std::less<>());
  wall.upper = without_ends(std::move(wall.upper), std::greater<>());
  return wall;
}

GroundedWalls::GroundedWalls(std::vector<WallProfile> walls, const GroundHeightAt& ground_height) {
  const auto is_grounded = [&](const WallProfile& wall) {
    const std::vector<double> places = places_along(wall.lower);
    return std::all_of(places.begin(), places.end(), [&](double along_m) {
      const Point2d p = wall.place(along_m);
      const double z_m = wall.lower_m(along_m);
      return z_m <= ground_height(p) + ground_contact_m || reach_up_to(p, z_m);
    });
  };
  // A wall may rest on another wall, and this one on a third: repeat until no more walls are found
  for (bool more = true; more;) {
    const auto rest = std::stable_partition(walls.begin(), walls.end(), is_grounded);
    more = rest != walls.begin();
    std::move(walls.begin(), rest, std::back_inserter(grounded_));
    walls.erase(walls.begin(), rest);
  }
}

bool GroundedWalls::reach_up_to(Point2d p, double z_m) const {
  return std::any_of(grounded_.begin(), grounded_.end(), [&](const WallProfile& wall) {
    const Point2d from_begin = p - wall.begin;
    const double along_m = dot(wall.direction, from_begin);
    return std::abs(across(wall.direction, from_begin)) <= on_line_m && along_m >= -on_line_m &&
           along_m <= wall.length_m + on_line_m && wall.upper_m(along_m) >= z_m - on_line_m;
  });
}

bool GroundedWalls::close_below(const Segment3d& s) const {
  return std::any_of(grounded_.begin(), grounded_.end(), [&](const WallProfile& wall) {
    // The segment must lie in the plane of the wall, between its ends
    const Point2d a = horizontal(s.a) - wall.begin, b = horizontal(s.b) - wall.begin;
    double from = dot(wall.direction, a), to = dot(wall.direction, b);
    if (std::abs(across(wall.direction, a)) > upright_offset_m || std::abs(across(wall.direction, b)) > upright_offset_m ||
        std::min(from, to) < -on_line_m || std::max(from, to) > wall.length_m + on_line_m)
      return false;
    const auto is_below = [&](double share) {
      return std::lerp(s.a.z, s.b.z, share) <= wall.upper_m(std::lerp(from, to, share)) + on_line_m;
    };
    // Both are straight between the points of the border: compare at the ends of the segment and at these points
    if (!is_below(0.0) || !is_below(1.0)) return false;
    return std::all_of(wall.upper.begin(), wall.upper.end(), [&](const WallPoint& p) {
      const double share = (p.along_m - from) / (to - from);
      return std::abs(to - from) <= on_line_m || share <= 0.0 || share >= 1.0 || is_below(share);
    });
  });
}

std::vector<HorizonSegment> above_ground(const std::vector<HorizonSegment>& undersides, const Ground& ground) {
  std::vector<HorizonSegment> result;
  for (const HorizonSegment& underside : undersides) {
    const Point3d &a = underside.segment.a, &b = underside.segment.b;
    const auto intervals = static_cast<std::size_t>(ground_sampling_intervals(norm(horizontal(b - a))));
    const auto point_at = [&](std::size_t k) { return a + static_cast<double>(k) / static_cast<double>(intervals) * (b - a); };
    std::vector<bool> is_above;
    for (std::size_t k = 0; k <= intervals; ++k) is_above.push_back(ground.is_above(point_at(k), ground_contact_m));
    // An interval counts as above the ground when one of its ends is; join consecutive intervals
    for (std::size_t from = 0, to = 0; from < intervals; from = to + 1) {
      for (to = from; to < intervals && (is_above[to] || is_above[to + 1]); ++to) {
      }
      if (to > from) result.push_back({{point_at(from), point_at(to)}, underside.adjacent, underside.role});
    }
  }
  return result;
}

}  // namespace farlod::tiles
