// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

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

using Corners = std::array<Point3d, 3>;  ///< in an EdgeFrame

struct Contact {
  Stretch stretch;
  CrossSection section;
  Corners corners;
  [[nodiscard]] Point3d nearest_to(double at_m) const;
  /// The largest distance of the triangle from a stretch: it is convex, so no place between is farther away than both ends.
  [[nodiscard]] double distance_m(const Stretch& s) const {
    const Point3d from{s.from_m, 0.0, 0.0}, to{s.to_m, 0.0, 0.0};
    return std::max(norm(nearest_to(s.from_m) - from), norm(nearest_to(s.to_m) - to));
  }
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
  /// A point as it is, by its coordinates in this frame.
  [[nodiscard]] Point3d place(const Point3d& seen) const { return a_ + seen.x * along_ + seen.y * left_ + seen.z * up_; }

 private:
  Point3d a_, along_, left_, up_;
  double length_m_ = 0.0;
};

/// The stretch of the edge (the x axis) that is within `contact_m` of the triangle, measured in its plane and perpendicular to
/// it; nothing when the stretch is too short to count.
std::optional<Stretch> touched(const Corners& t, double length_m, double beyond_sides_m = contact_m) {
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
    limit(outward.x, dot(outward, t[n]) + beyond_sides_m);
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
      contacts.push_back({*stretch, section_at(corners, 0.5 * (stretch->from_m + stretch->to_m)), corners});
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

/// The point of a triangle that is nearest to a place of the edge.
Point3d Contact::nearest_to(double at_m) const {
  const Point3d p{at_m, 0.0, 0.0}, normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  Point3d nearest = p - dot(normal, p - corners[0]) * normal;
  bool is_inside = true;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3d &a = corners[n], side = corners[(n + 1) % 3] - a;
    if (dot(cross(side, normal), p - a) <= 0.0) continue;
    // Beyond this side: the nearest point is on one of those that the place is beyond
    const Point3d on_side = a + std::clamp(dot(p - a, side) / dot(side, side), 0.0, 1.0) * side;
    if (const double distance_m = norm(on_side - p); is_inside || distance_m < least_m) {
      nearest = on_side;
      least_m = distance_m;
    }
    is_inside = false;
  }
  return nearest;
}

/// The contacts that touch a stretch on which no contact begins or ends.
std::vector<const Contact*> touching(const std::vector<Contact>& contacts, const Stretch& s) {
  const double middle_m = 0.5 * (s.from_m + s.to_m);
  std::vector<const Contact*> result;
  for (const Contact& c : contacts)
    if (c.stretch.from_m <= middle_m && middle_m <= c.stretch.to_m) result.push_back(&c);
  return result;
}

/// What closes a lower border across the cracks between it and what touches it, stretch by stretch along the border.
class Closing {
 public:
  explicit Closing(const EdgeFrame& frame) : frame_(frame) {}

  /// Whether a stretch is closed by contacts which touch it all along. If some leave a crack, it is noted down: the nearest ones
  /// count that close the stretch.
  bool close(const Stretch& stretch, const std::vector<const Contact*>& touching) {
    CrossSection all, section;
    for (const Contact* contact : touching) all.add(contact->section);
    if (!all.is_closed()) return false;
    std::vector<std::pair<double, const Contact*>> apart;
    for (const Contact* contact : touching)
      if (const double distance_m = contact->distance_m(stretch); distance_m <= least_crack_m)
        section.add(contact->section);
      else
        apart.emplace_back(distance_m, contact);
    std::stable_sort(apart.begin(), apart.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& nearest : apart) {
      if (section.is_closed()) break;
      section.add(nearest.second->section);
      add_strip(stretch, *nearest.second);
    }
    return true;
  }
  void add_triangles(std::vector<ClosingTriangle>& triangles) const {
    for (const Strip& s : strips_) {
      const auto& [from_m, to_m] = s.stretch;
      const Point3d end = on_border(to_m);
      close_crack({on_border(from_m), end}, {on_contact(s, from_m), on_contact(s, to_m)}, triangles);
      // Where one strip goes on as another one, what is between both
      for (const Strip& next : strips_)
        if (next.stretch.from_m == to_m) close_crack({end, end}, {on_contact(s, to_m), on_contact(next, to_m)}, triangles);
    }
  }

 private:
  struct Strip {
    Stretch stretch;
    const Contact* contact;
  };
  void add_strip(const Stretch& stretch, const Contact& contact) {
    for (Strip& s : strips_)
      if (s.contact == &contact && s.stretch.to_m == stretch.from_m) {
        s.stretch.to_m = stretch.to_m;
        return;
      }
    strips_.push_back({stretch, &contact});
  }
  [[nodiscard]] Point3d on_border(double at_m) const { return frame_.place({at_m, 0.0, 0.0}); }
  [[nodiscard]] Point3d on_contact(const Strip& strip, double at_m) const {
    return frame_.place(strip.contact->nearest_to(at_m));
  }

  const EdgeFrame& frame_;
  std::vector<Strip> strips_;
};

/// Cuts the edge where contacts begin and end: on each interval between, the set of contacts is constant.
std::vector<double> places_between_contacts(const std::vector<Contact>& contacts, double length_m) {
  std::vector<double> places{0.0, length_m};
  const auto add_ends = [&](const Stretch& s) {
    places.push_back(std::clamp(s.from_m, 0.0, length_m));
    places.push_back(std::clamp(s.to_m, 0.0, length_m));
  };
  for (const Contact& c : contacts) {
    add_ends(c.stretch);
    // Where it is right beside the triangle, and not beyond one of its sides
    if (const auto beside = touched(c.corners, length_m, 0.0)) add_ends(*beside);
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

std::vector<HorizonEdge> without_contacts(const HorizonEdge& edge, const Tile& tile, std::vector<ClosingTriangle>& closing) {
  const EdgeFrame frame(edge);
  if (!(frame.length_m() > on_line_m)) return {};
  const std::vector<Contact> contacts = contacts_of(edge, frame, tile);
  const std::vector<double> places = places_between_contacts(contacts, frame.length_m());
  // Join consecutive open intervals, and keep those that are longer than the tolerance
  std::vector<Stretch> joined;
  Closing cracks(frame);
  bool was_open = false;
  for (std::size_t n = 1; n < places.size(); ++n) {
    const Stretch interval{places[n - 1], places[n]};
    const bool is_open = !cracks.close(interval, touching(contacts, interval));
    if (is_open && was_open)
      joined.back().to_m = interval.to_m;
    else if (is_open)
      joined.push_back(interval);
    was_open = is_open;
  }
  std::vector<HorizonEdge> open;
  for (const auto& [from_m, to_m] : joined)
    if (to_m - from_m > contact_m) open.push_back(part_of(edge, from_m / frame.length_m(), to_m / frame.length_m()));
  cracks.add_triangles(closing);
  return open;
}

void close_crack(const std::array<Point3d, 2>& border, const std::array<Point3d, 2>& other,
                 std::vector<ClosingTriangle>& closing) {
  // What is smaller has no inside when it is rounded
  constexpr double least_area_m2 = 1e-7;
  const auto add = [&](const ClosingTriangle& t) {
    if (norm(cross(t[1] - t[0], t[2] - t[0])) > 2.0 * least_area_m2) closing.push_back(t);
  };
  add({border[0], border[1], other[1]});
  add({border[0], other[1], other[0]});
}

}  // namespace farlod::tiles
