// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_sky.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace farlod {
namespace {

/// What is nearer than this in the plan is left out: there is no picture of what is straight overhead.
constexpr double overhead_m = 1e-9;
/// The same for what is higher: F above it is below 1e-14, so less than the rounding of a sum.
constexpr double highest_y = 1e7;
/// Polygons are cut off here, below all floors.
constexpr double lowest_y = -1.0;

/// A convex polygon in the frame of a wedge.
template <std::size_t most_corners>
class Clipped {
 public:
  explicit Clipped(const std::array<Point3d, 3>& triangle) { std::copy(triangle.begin(), triangle.end(), corners_.begin()); }
  [[nodiscard]] std::span<const Point3d> corners() const { return {corners_.data(), count_}; }

  /// Keeps what is in front of a plane (Sutherland and Hodgman 1974).
  void keep(const Point3d& normal, const Point3d& axis, double offset = 0.0) {
    const auto height = [&](const Point3d& p) { return dot(p, normal) - offset; };
    // From the end in front of the plane, so that two triangles have the same place on the edge that they share; and back to the
    // plane along an axis, so that its rounding is that of near places, however long the edge
    const auto crossing = [&](const Point3d& in_front, const Point3d& behind) {
      const double share = height(in_front) / (height(in_front) - height(behind));
      const Point3d at = in_front + share * (behind - in_front);
      return at - (height(at) / dot(normal, axis)) * axis;
    };
    std::array<Point3d, most_corners> kept;
    std::size_t count = 0;
    for (std::size_t n = 0; n < count_; ++n) {
      const Point3d &p = corners_[n], &q = corners_[n + 1 < count_ ? n + 1 : 0];
      const bool keeps_p = height(p) >= 0.0, keeps_q = height(q) >= 0.0;
      if (keeps_p) kept[count++] = p;
      if (keeps_p != keeps_q) kept[count++] = keeps_p ? crossing(p, q) : crossing(q, p);
    }
    corners_ = kept;
    count_ = count;
  }

 private:
  std::array<Point3d, most_corners> corners_;
  std::size_t count_ = 3;
};

/// Between the same ends.
bool is_nowhere_above(const PicturePlane::Segment& line, const PicturePlane::Segment& other) {
  return line.left.y <= other.left.y && line.right.y <= other.right.y;
}

}  // namespace

/// Places come by τ, then by y. What is kept is convex (sense 1) or concave (sense −1).
void WedgeSky::Border::add(const Place& place, double sense) {
  if (count > 0 && places[count - 1].t == place.t) {
    if (sense > 0.0) return;
    --count;
  }
  const auto is_turning = [&](const Place& a, const Place& b) {
    return sense * ((b.t - a.t) * (place.y - a.y) - (b.y - a.y) * (place.t - a.t)) > 0.0;
  };
  while (count >= 2 && !is_turning(places[count - 2], places[count - 1])) --count;
  places[count++] = place;
}

double WedgeSky::Border::at(double t) const {
  std::size_t n = 1;
  while (n + 1 < count && places[n].t < t) ++n;
  // A steep segment has its corners' own heights, so that the next one begins there
  return t == places[n].t ? places[n].y : Segment(places[n - 1], places[n]).at(t);
}

bool WedgeSky::Border::reaches_beyond(const Segment& line, double sense) const {
  const auto is_beyond = [&](const Place& place) { return sense * (place.y - line.at(place.t)) > 0.0; };
  const double left = std::max(from(), line.left.t), right = std::min(to(), line.right.t);
  if (is_beyond({left, at(left)}) || is_beyond({right, at(right)})) return true;
  return std::any_of(corners().begin(), corners().end(),
                     [&](const Place& place) { return place.t > left && place.t < right && is_beyond(place); });
}

bool WedgeSky::Border::has_corner_inside(const Segment& part) const {
  return std::any_of(corners().begin(), corners().end(),
                     [&](const Place& place) { return place.t > part.left.t && place.t < part.right.t; });
}

void WedgeSky::begin(const Wedge& wedge, const Point3d& normal, SkyWeight weight) {
  picture_.emplace(wedge, normal, weight);
  polygons_.clear();
}

void WedgeSky::add(const std::array<Point3d, 3>& triangle) {
  const double tangent = picture_->tangent();
  Clipped<most_corners> clipped(
      {picture_->in_wedge(triangle[0]), picture_->in_wedge(triangle[1]), picture_->in_wedge(triangle[2])});
  constexpr Point3d along{1.0, 0.0, 0.0}, left{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};
  clipped.keep(left, left);
  clipped.keep(tangent * along - left, left);
  clipped.keep(up - lowest_y * along, up);
  clipped.keep(highest_y * along - up, up);
  clipped.keep(along, along, overhead_m);
  if (clipped.corners().size() < 3) return;
  places_.clear();
  for (const Point3d& p : clipped.corners()) places_.push_back({std::clamp(p.y / p.x, 0.0, tangent), p.z / p.x});
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.t != b.t ? a.t < b.t : a.y < b.y; });
  Polygon polygon;
  for (const Place& place : places_) {
    polygon.lower.add(place, 1.0);
    polygon.upper.add(place, -1.0);
  }
  if (polygon.lower.from() < polygon.lower.to()) polygons_.push_back(polygon);
}

WedgeSky::Sky WedgeSky::sky() {
  sky_ = {};
  candidates_.resize(polygons_.size());
  std::iota(candidates_.begin(), candidates_.end(), 0U);
  slabs_.clear();
  for (const Segment& floor : picture_->floor()) add_part(floor, {0, candidates_.size(), 0, 0});
  return sky_;
}

void WedgeSky::add_part(Segment floor, const Range& whole) {
  const std::size_t first_polygon = candidates_.size(), first_slab = slabs_.size();
  collect(floor, whole);
  floor = join_slabs(floor, first_slab);
  drop_hidden_polygons(floor, first_polygon, first_slab);
  if (const std::optional<double> t = middle_corner(floor, first_polygon)) {
    const Range part{first_polygon, candidates_.size(), first_slab, slabs_.size()};
    const Place middle{*t, floor.at(*t)};
    add_part({floor.left, middle}, part);
    add_part({middle, floor.right}, part);
  } else {
    add_between_slabs(floor, first_slab);
  }
  candidates_.resize(first_polygon);
  slabs_.erase(slabs_.begin() + static_cast<std::ptrdiff_t>(first_slab), slabs_.end());
}

/// What of the whole reaches into a part. A polygon that covers it hides the slab between its corners at both ends, since it is
/// convex, and no more than that if it has no other corners there.
void WedgeSky::collect(const Segment& part, const Range& whole) {
  const double from = part.left.t, to = part.right.t;
  const auto add_slab = [&](const auto& lower, const auto& upper) {
    slabs_.push_back({{{from, lower.at(from)}, {to, lower.at(to)}}, {{from, upper.at(from)}, {to, upper.at(to)}}});
  };
  for (std::size_t n = whole.first_slab; n < whole.last_slab; ++n) add_slab(Segment(slabs_[n].lower), Segment(slabs_[n].upper));
  for (std::size_t n = whole.first_polygon; n < whole.last_polygon; ++n) {
    const std::uint32_t number = candidates_[n];
    const auto& [lower, upper] = polygons_[number];
    if (lower.from() >= to || lower.to() <= from) continue;
    const bool covers = lower.from() <= from && lower.to() >= to;
    if (covers) add_slab(lower, upper);
    if (!covers || lower.has_corner_inside(part) || upper.has_corner_inside(part)) candidates_.push_back(number);
  }
}

/// Joins slabs, from below, to the floor and to each other, where no gap is between them at either end and their borders do not
/// cross. The floor that results.
WedgeSky::Segment WedgeSky::join_slabs(Segment floor, std::size_t first) {
  std::sort(slabs_.begin() + static_cast<std::ptrdiff_t>(first), slabs_.end(),
            [](const Slab& a, const Slab& b) { return a.lower.left.y + a.lower.right.y < b.lower.left.y + b.lower.right.y; });
  std::size_t kept = first;
  for (std::size_t n = first; n < slabs_.size(); ++n) {
    const Slab slab = slabs_[n];
    if (is_nowhere_above(slab.upper, floor)) continue;
    if (is_nowhere_above(slab.lower, floor) && is_nowhere_above(floor, slab.upper))
      floor = slab.upper;
    else if (!is_joined(slab, first, kept))
      slabs_[kept++] = slab;
  }
  slabs_.erase(slabs_.begin() + static_cast<std::ptrdiff_t>(kept), slabs_.end());
  return floor;
}

/// Joins a slab to one of others, if it can be.
bool WedgeSky::is_joined(const Slab& slab, std::size_t first, std::size_t last) {
  for (std::size_t n = last; n > first; --n) {
    Slab& other = slabs_[n - 1];
    if (!is_nowhere_above(other.lower, slab.lower) || !is_nowhere_above(slab.lower, other.upper)) continue;
    if (is_nowhere_above(slab.upper, other.upper)) return true;
    if (!is_nowhere_above(other.upper, slab.upper)) continue;
    other.upper = slab.upper;
    return true;
  }
  return false;
}

void WedgeSky::drop_hidden_polygons(const Segment& floor, std::size_t first_polygon, std::size_t first_slab) {
  const auto slabs = std::span(slabs_).subspan(first_slab);
  const auto is_hidden = [&](std::uint32_t number) {
    const Polygon& polygon = polygons_[number];
    return !polygon.reaches_above(floor) || std::any_of(slabs.begin(), slabs.end(), [&](const Slab& slab) {
      return !polygon.reaches_above(slab.upper) && !polygon.reaches_below(slab.lower);
    });
  };
  const auto from = candidates_.begin() + static_cast<std::ptrdiff_t>(first_polygon);
  candidates_.erase(std::remove_if(from, candidates_.end(), is_hidden), candidates_.end());
}

/// The middle one of the corners inside of a part.
std::optional<double> WedgeSky::middle_corner(const Segment& part, std::size_t first) {
  corners_.clear();
  for (std::size_t n = first; n < candidates_.size(); ++n) {
    const Polygon& polygon = polygons_[candidates_[n]];
    for (const Border* border : {&polygon.lower, &polygon.upper})
      for (const Place& place : border->corners())
        if (place.t > part.left.t && place.t < part.right.t) corners_.push_back(place.t);
  }
  if (corners_.empty()) return std::nullopt;
  const auto middle = corners_.begin() + static_cast<std::ptrdiff_t>(corners_.size() / 2);
  std::nth_element(corners_.begin(), middle, corners_.end());
  return *middle;
}

/// Where the order of borders changes in a part without corners, with both its ends.
void WedgeSky::find_crossings(const Segment& floor, std::size_t first) {
  lines_.assign(1, floor);
  for (std::size_t n = first; n < slabs_.size(); ++n) {
    lines_.push_back(slabs_[n].lower);
    lines_.push_back(slabs_[n].upper);
  }
  const double from = floor.left.t, to = floor.right.t;
  crossings_.assign({from, to});
  for (std::size_t n = 0; n < lines_.size(); ++n)
    for (std::size_t m = 0; m < n; ++m) {
      const double left = lines_[n].left.y - lines_[m].left.y, right = lines_[n].right.y - lines_[m].right.y;
      if ((left < 0.0 && right > 0.0) || (left > 0.0 && right < 0.0))
        crossings_.push_back(std::clamp(from + (to - from) * (left / (left - right)), from, to));
    }
  std::sort(crossings_.begin(), crossings_.end());
}

void WedgeSky::add_between_slabs(const Segment& floor, std::size_t first) {
  find_crossings(floor, first);
  for (std::size_t n = 1; n < crossings_.size(); ++n)
    if (crossings_[n - 1] < crossings_[n]) add_strip(floor, first, crossings_[n - 1], crossings_[n]);
}

/// What is open between lines that do not cross each other: the order in the middle is that of all of the strip.
void WedgeSky::add_strip(const Segment& floor, std::size_t first, double from, double to) {
  const double middle = 0.5 * (from + to);
  hidden_.clear();
  for (std::size_t n = first; n < slabs_.size(); ++n)
    hidden_.push_back({slabs_[n].lower.at(middle), slabs_[n].upper.at(middle), &slabs_[n]});
  std::sort(hidden_.begin(), hidden_.end(), [](const Hidden& a, const Hidden& b) { return a.low < b.low; });
  const auto above = [&](const Segment& line) { return picture_->sky_above({from, line.at(from)}, {to, line.at(to)}); };
  const auto add_gap = [&](const Segment& line, double sky) {
    if (!(sky > 0.0)) return;
    sky_.sky += sky;
    sky_.lowest = std::min({sky_.lowest, line.at(from), line.at(to)});
  };
  const Segment* reached = &floor;
  double reached_y = floor.at(middle);
  for (const auto& [low, high, slab] : hidden_) {
    if (low > reached_y) add_gap(*reached, above(*reached) - above(slab->lower));
    if (high <= reached_y) continue;
    reached = &slab->upper;
    reached_y = high;
  }
  add_gap(*reached, above(*reached));
}

}  // namespace farlod
