// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plane_polygons.hpp"

#include <algorithm>
#include <utility>

#include "base/expects.hpp"

namespace farlod {
namespace {

using NumberRing = std::vector<std::uint32_t>;

/// Narrower pieces are the result of rounding where two edges should coincide.
constexpr double narrowest_m = 2e-3;

[[nodiscard]] double cross(Point2d a, Point2d b) { return a.x * b.y - a.y * b.x; }

[[nodiscard]] bool is_sliver(const PlanePolygon& polygon) {
  double longest_m = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    longest_m = std::max(longest_m, norm(polygon[(k + 1) % polygon.size()] - polygon[k]));
  return polygon.size() < 3 || area(polygon) <= narrowest_m * longest_m;
}

[[nodiscard]] bool are_one(Point2d a, Point2d b) { return norm(b - a) < 1e-6; }

/// Right of the directed line from a to b.
[[nodiscard]] HalfPlane right_of(Point2d a, Point2d b) {
  const Point2d slope{a.y - b.y, b.x - a.x};
  return {slope, -dot(slope, a)};
}

/// Twice the signed area of the triangle a, b, c.
[[nodiscard]] std::int64_t turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

[[nodiscard]] bool is_between(const GridPoint& a, const GridPoint& p, const GridPoint& b) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] &&
         p[1] <= std::max(a[1], b[1]);
}

/// Whether the segments a–b and c–d have a point in common other than an end of a–b that is an end of c–d.
[[nodiscard]] bool are_crossing(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto sign = [](std::int64_t x) { return x < 0 ? -1 : x > 0 ? 1 : 0; };
  const auto on = [&](const GridPoint& from, const GridPoint& p, const GridPoint& to) {
    return turn(from, p, to) == 0 && is_between(from, p, to);
  };
  const bool shares_a = a == c || a == d, shares_b = b == c || b == d;
  if ((!shares_a && on(c, a, d)) || (!shares_b && on(c, b, d))) return true;
  if ((c != a && c != b && on(a, c, b)) || (d != a && d != b && on(a, d, b))) return true;
  if (shares_a || shares_b) return false;
  return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

/// Joins holes to the outer ring by bridges. The result is one ring that touches itself.
class HoleBridges {
 public:
  HoleBridges(std::span<const GridPoint> points, std::vector<NumberRing> rings) : points_(points), rings_(std::move(rings)) {}

  [[nodiscard]] NumberRing joined() {
    // From the right end of the rightmost hole, a corner of the outer ring is visible
    const auto right_end = [this](const NumberRing& ring) {
      return *std::ranges::max_element(ring, {}, [this](std::uint32_t k) { return points_[k]; });
    };
    std::sort(rings_.begin() + 1, rings_.end(),
              [&](const NumberRing& a, const NumberRing& b) { return points_[right_end(a)] > points_[right_end(b)]; });
    while (rings_.size() > 1) join(right_end(rings_[1]));
    return rings_.front();
  }

 private:
  /// Connects corner `from` of a hole with the nearest visible corner of the ring, and inserts the hole there.
  void join(std::uint32_t from) {
    NumberRing& outer = rings_.front();
    const std::size_t at = nearest_visible(from);
    NumberRing& hole = rings_[1];
    std::rotate(hole.begin(), std::ranges::find(hole, from), hole.end());
    NumberRing detour = hole;
    detour.push_back(from);
    detour.push_back(outer[at]);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(at) + 1, detour.begin(), detour.end());
    rings_.erase(rings_.begin() + 1);
  }

  [[nodiscard]] std::size_t nearest_visible(std::uint32_t from) const {
    const NumberRing& outer = rings_.front();
    std::vector<std::pair<std::int64_t, std::size_t>> candidates;
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const std::int64_t x = points_[outer[k]][0] - points_[from][0], y = points_[outer[k]][1] - points_[from][1];
      candidates.emplace_back(x * x + y * y, k);
    }
    std::ranges::sort(candidates);
    for (const auto& [distance, k] : candidates)
      if (opens_towards(outer, k, from) && is_free(from, outer[k])) return k;
    FARLOD_EXPECTS(false && "a hole sees a corner of the ring around it");
    return 0;
  }

  /// Whether the inner angle at corner k contains the direction to `to`. It chooses among the copies of a corner that bridges
  /// made.
  [[nodiscard]] bool opens_towards(const NumberRing& ring, std::size_t k, std::uint32_t to) const {
    const std::size_t n = ring.size();
    const GridPoint &before = points_[ring[(k + n - 1) % n]], &here = points_[ring[k]], &after = points_[ring[(k + 1) % n]];
    const bool left_of_in = turn(before, here, points_[to]) > 0, left_of_out = turn(here, after, points_[to]) > 0;
    return turn(before, here, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }

  [[nodiscard]] bool is_free(std::uint32_t a, std::uint32_t b) const {
    for (const NumberRing& ring : rings_)
      for (std::size_t k = 0; k < ring.size(); ++k)
        if (are_crossing(points_[a], points_[b], points_[ring[k]], points_[ring[(k + 1) % ring.size()]])) return false;
    return true;
  }

  std::span<const GridPoint> points_;
  std::vector<NumberRing> rings_;
};

[[nodiscard]] bool is_ear(std::span<const GridPoint> points, const NumberRing& ring, std::size_t k) {
  const std::size_t n = ring.size();
  const GridPoint &a = points[ring[(k + n - 1) % n]], &b = points[ring[k]], &c = points[ring[(k + 1) % n]];
  if (turn(a, b, c) <= 0) return false;
  for (std::size_t m = 0; m < n; ++m) {
    const GridPoint& p = points[ring[m]];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

double area(const PlanePolygon& polygon) {
  double sum = 0.0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) sum += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return 0.5 * sum;
}

bool is_convex(const PlanePolygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k)
    if (cross(polygon[(k + 1) % n] - polygon[k], polygon[(k + 2) % n] - polygon[(k + 1) % n]) < 0.0) return false;
  return true;
}

PlanePolygon clipped(const PlanePolygon& convex, const HalfPlane& half_plane) {
  PlanePolygon result;
  for (std::size_t k = 0; k < convex.size(); ++k) {
    const Point2d a = convex[k], b = convex[(k + 1) % convex.size()];
    const double at_a = half_plane.value(a), at_b = half_plane.value(b);
    if (at_a <= 0.0) result.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0)) result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
  // The computed intersections of three lines through one point differ
  const auto last = std::unique(result.begin(), result.end(), are_one);
  result.erase(last, result.end());
  while (result.size() > 1 && are_one(result.front(), result.back())) result.pop_back();
  return result.size() < 3 ? PlanePolygon{} : result;
}

std::vector<PlanePolygon> without(const PlanePolygon& subject, const PlanePolygon& clip) {
  std::vector<PlanePolygon> outside;
  PlanePolygon rest = subject;
  // Each edge cuts off the part beyond it. The part that no edge cuts off is inside
  for (std::size_t k = 0; k < clip.size() && !rest.empty(); ++k) {
    const HalfPlane beyond = right_of(clip[k], clip[(k + 1) % clip.size()]);
    if (PlanePolygon piece = clipped(rest, beyond); !is_sliver(piece)) outside.push_back(std::move(piece));
    rest = clipped(rest, {-1.0 * beyond.slope, -beyond.offset});
  }
  if (is_sliver(rest)) return {subject};
  return outside;
}

std::vector<GridTriangle> triangles(std::span<const GridPoint> points, std::vector<std::vector<std::uint32_t>> rings) {
  NumberRing ring = HoleBridges(points, std::move(rings)).joined();
  std::vector<GridTriangle> result;
  // Continue after the last ear: the next one is mostly near
  for (std::size_t k = 0, tried = 0; ring.size() > 3;) {
    const std::size_t n = ring.size();
    FARLOD_EXPECTS(tried <= n);
    if (!is_ear(points, ring, k % n)) {
      ++k, ++tried;
      continue;
    }
    result.push_back({ring[(k + n - 1) % n], ring[k % n], ring[(k + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k % n));
    tried = 0;
  }
  result.push_back({ring[0], ring[1], ring[2]});
  return result;
}

}  // namespace farlod
