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

namespace {

Point3d exactly(const Point3f& p) { return {p.x, p.y, p.z}; }

/// A part of an edge, in metres from its first end.
struct Stretch {
  double from_m = 0.0, to_m = 0.0;
};

/// The triangles beside a stretch, in the plane perpendicular to the edge.
struct CrossSection {
  /// The smallest rise on either side, as in EdgeSides.
  double left_rad = std::numeric_limits<double>::infinity(), right_rad = left_rad;
  bool goes_down = false;  ///< a vertical triangle lies below the edge

  void add(const CrossSection& o) {
    left_rad = std::min(left_rad, o.left_rad);
    right_rad = std::min(right_rad, o.right_rad);
    goes_down |= o.goes_down;
  }
  [[nodiscard]] bool is_closed() const { return goes_down || left_rad + right_rad <= slight_bend_rad; }
};

struct Contact {
  Stretch stretch;
  CrossSection section;
};

/// Coordinates of an edge: x along the edge, y horizontally to its left, z perpendicular to both, upwards.
class EdgeFrame {
 public:
  explicit EdgeFrame(const HorizonEdge& e) : a_(exactly(e.a)) {
    const Point3d way = exactly(e.b) - a_;
    length_m_ = norm(way);
    along_ = (1.0 / length_m_) * way;
    const double run = norm(horizontal(along_));
    left_ = {-along_.y / run, along_.x / run, 0.0};
    up_ = cross(along_, left_);
  }
  [[nodiscard]] double length_m() const { return length_m_; }
  [[nodiscard]] Point3d seen(const Point3f& p) const {
    const Point3d v = exactly(p) - a_;
    return {dot(v, along_), dot(v, left_), dot(v, up_)};
  }

 private:
  Point3d a_, along_, left_, up_;
  double length_m_ = 0.0;
};

using Corners = std::array<Point3d, 3>;  ///< in an EdgeFrame

/// The stretch of the edge (the x axis) that is within `contact_m` of the triangle, measured in its plane and perpendicular to
/// it; nothing when the stretch is too short to count.
std::optional<Stretch> touched(const Corners& t, double length_m) {
  const Point3d normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
  if (normal == Point3d{}) return std::nullopt;
  // Each condition is linear along the edge, s·rate ≤ room, and cuts the stretch at one end
  Stretch s{0.0, length_m};
  const auto limit = [&s](double rate, double room) {
    if (rate > 0.0) s.to_m = std::min(s.to_m, room / rate);
    if (rate < 0.0) s.from_m = std::max(s.from_m, room / rate);
    if (rate == 0.0 && room < 0.0) s.to_m = -1.0;
  };
  // The distance from the triangle's plane is at most contact_m on either side
  const double off_plane = dot(normal, t[0]);
  limit(normal.x, off_plane + contact_m);
  limit(-normal.x, -off_plane + contact_m);
  // The distance beyond each side of the triangle is at most contact_m
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3d side = t[(n + 1) % 3] - t[n];
    const Point3d outward = normalized(cross(side, normal));
    limit(outward.x, dot(outward, t[n]) + contact_m);
  }
  // A triangle that meets the edge in a point touches it along 2·contact_m: that is no contact
  if (s.to_m - s.from_m <= 2.0 * contact_m && s.to_m - s.from_m < 0.5 * length_m) return std::nullopt;
  return s;
}

/// Whether a triangle counts as vertical for the edge, as in EdgeSides: judged by its plane, since its cross section may be
/// short.
bool counts_as_vertical(const Corners& t) {
  const Point3d normal = cross(t[1] - t[0], t[2] - t[0]);
  const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
  const double longest_m = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  // Corners are rounded: over the smallest height of the triangle, this turns its plane
  const double rounding = longest_m * on_line_m / norm(normal);
  const double lean = std::abs(normal.z) / std::abs(normal.y);
  return lean <= std::max(leaning_wall_z, rounding) && lean * (high - low) <= max_lean_m;
}

/// The cross section of the triangle with the plane perpendicular to the edge at `at_m`.
CrossSection section_at(const Corners& t, double at_m) {
  const bool is_wall = counts_as_vertical(t);
  CrossSection section;
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3d &a = t[n], &b = t[(n + 1) % 3];
    // Intersect a side of the triangle with that plane
    const double da = a.x - at_m, db = b.x - at_m;
    if (da * db > 0.0 || da == db) continue;
    const double share = da / (da - db), aside_m = a.y + share * (b.y - a.y), rise_m = a.z + share * (b.z - a.z);
    // The end at the edge itself has no direction
    if (std::hypot(aside_m, rise_m) <= 2.0 * contact_m) continue;
    // A nearly vertical triangle closes the edge when it lies below, and has no effect when it rises
    if (is_wall && std::abs(rise_m) > std::abs(aside_m)) {
      section.goes_down |= rise_m < 0.0;
      continue;
    }
    double& side_rad = aside_m > 0.0 ? section.left_rad : section.right_rad;
    side_rad = std::min(side_rad, std::atan2(rise_m, std::abs(aside_m)));
  }
  return section;
}

std::vector<Contact> contacts_of(const HorizonEdge& edge, const EdgeFrame& frame, const Tile& tile) {
  // Compare bounding boxes first: most triangles of the tile are far away
  constexpr auto give = static_cast<float>(contact_m);
  const Point3f low{std::min(edge.a.x, edge.b.x) - give, std::min(edge.a.y, edge.b.y) - give,
                    std::min(edge.a.z, edge.b.z) - give};
  const Point3f high{std::max(edge.a.x, edge.b.x) + give, std::max(edge.a.y, edge.b.y) + give,
                     std::max(edge.a.z, edge.b.z) + give};
  std::vector<Contact> contacts;
  for (const Triangle& t : tile.triangles) {
    const Point3f &a = tile.vertices[t.a], &b = tile.vertices[t.b], &c = tile.vertices[t.c];
    if (std::min({a.x, b.x, c.x}) > high.x || std::max({a.x, b.x, c.x}) < low.x || std::min({a.y, b.y, c.y}) > high.y ||
        std::max({a.y, b.y, c.y}) < low.y || std::min({a.z, b.z, c.z}) > high.z || std::max({a.z, b.z, c.z}) < low.z)
      continue;
    const Corners corners{frame.seen(a), frame.seen(b), frame.seen(c)};
    if (const auto stretch = touched(corners, frame.length_m()))
      contacts.push_back({*stretch, section_at(corners, 0.5 * (stretch->from_m + stretch->to_m))});
  }
  return contacts;
}

HorizonEdge part_of(const HorizonEdge& edge, double from, double to) {
  const auto at = [&](double share) {
    return Point3f{static_cast<float>(std::lerp(double{edge.a.x}, double{edge.b.x}, share)),
                   static_cast<float>(std::lerp(double{edge.a.y}, double{edge.b.y}, share)),
                   static_cast<float>(std::lerp(double{edge.a.z}, double{edge.b.z}, share))};
  };
  return {at(from), at(to), edge.adjacent, edge.role};
}

}  // namespace

std::vector<HorizonEdge> without_contacts(const HorizonEdge& edge, const Tile& tile) {
  const EdgeFrame frame(edge);
  if (!(frame.length_m() > on_line_m)) return {};
  const std::vector<Contact> contacts = contacts_of(edge, frame, tile);
  // Cut the edge where contacts begin and end: on each interval between, the set of contacts is constant
  std::vector<double> places{0.0, frame.length_m()};
  for (const Contact& c : contacts) {
    places.push_back(std::max(c.stretch.from_m, 0.0));
    places.push_back(std::min(c.stretch.to_m, frame.length_m()));
  }
  std::sort(places.begin(), places.end());
  // Join consecutive open intervals, and keep those that are longer than the tolerance
  std::vector<HorizonEdge> open;
  std::optional<double> open_from;
  for (std::size_t n = 1; n < places.size(); ++n) {
    const double middle_m = 0.5 * (places[n - 1] + places[n]);
    CrossSection section;
    for (const Contact& c : contacts)
      if (c.stretch.from_m <= middle_m && middle_m <= c.stretch.to_m) section.add(c.section);
    const bool is_open = !section.is_closed();
    if (is_open && !open_from) open_from = places[n - 1];
    const bool ends = n + 1 == places.size() || !is_open;
    const double open_to = is_open ? places[n] : places[n - 1];
    if (open_from && ends && open_to - *open_from > contact_m)
      open.push_back(part_of(edge, *open_from / frame.length_m(), open_to / frame.length_m()));
    if (!is_open) open_from.reset();
  }
  return open;
}

}  // namespace farlod::tiles
