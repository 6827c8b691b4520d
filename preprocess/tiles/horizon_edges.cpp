// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/horizon_edges.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/cutting.hpp"

namespace farlod::tiles {
namespace {

/// -0.0 equals 0.0, but its bits differ.
Point3d without_minus_zero(const Point3d& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }

/// The point at the share `t` of a segment. Both ends are exact, and no point lies beyond them.
Point3d lerped(const Segment3d& s, double t) {
  return {std::lerp(s.a.x, s.b.x, t), std::lerp(s.a.y, s.b.y, t), std::lerp(s.a.z, s.b.z, t)};
}

/// Appends the shares, between 0 and 1, at which a coordinate that runs from `a` to `b` crosses a border of the grid.
void add_crossings(double a, double b, const Grid& grid, std::vector<double>& places) {
  const std::int32_t last = grid.interval_of(std::max(a, b));
  for (std::int32_t k = grid.interval_of(std::min(a, b)) + 1; k <= last; ++k) places.push_back((grid.border_m(k) - a) / (b - a));
}

double distance_from_line_m(const Point3d& p, const Segment3d& s) {
  const Point3d along = s.b - s.a;
  return norm(cross(along, p - s.a)) / norm(along);
}

/// A part of an edge, and the ends of the part of another one beside it.
struct SharedStretch {
  ShareStretch stretch;
  std::array<Point3d, 2> other;
  double distance_m = 0.0;  ///< the largest between both
  [[nodiscard]] Point3d other_at(double share) const {
    return other[0] + (share - stretch.from) / (stretch.to - stretch.from) * (other[1] - other[0]);
  }
};

/// The part of `s` that `other` covers, where both lie on one line; nothing where they do not.
std::optional<SharedStretch> shared_stretch(const Segment3d& s, const Segment3d& other) {
  // Project the ends of the other segment onto this one
  const Point3d along = s.b - s.a;
  const double square = dot(along, along);
  const auto share_of = [&](const Point3d& p) { return dot(p - s.a, along) / square; };
  const auto [low, high] = std::minmax({share_of(other.a), share_of(other.b)});
  const ShareStretch shared{std::max(low, 0.0), std::min(high, 1.0)};
  if ((shared.to - shared.from) * std::sqrt(square) <= on_line_m) return std::nullopt;
  // Test the distance of the other segment from the line at the ends of the shared part: beyond them it may be anywhere
  const Point3d other_along = other.b - other.a;
  const auto on_other = [&](double share) {
    const double t = (share - share_of(other.a)) * square / dot(other_along, along);
    return point_at(other, std::clamp(t, 0.0, 1.0));
  };
  SharedStretch both{shared, {on_other(shared.from), on_other(shared.to)}};
  for (const Point3d& p : both.other) both.distance_m = std::max(both.distance_m, distance_from_line_m(p, s));
  return both.distance_m <= on_line_m ? std::optional(both) : std::nullopt;
}

/// Edges ordered by their west end, to find those near an edge.
class SortedEdges {
 public:
  explicit SortedEdges(std::vector<const EdgeSides*> edges) : edges_(std::move(edges)) {
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const EdgeSides* a, const EdgeSides* b) { return west_of(*a) < west_of(*b); });
    for (const EdgeSides* e : edges_) widest_m_ = std::max(widest_m_, east_of(*e) - west_of(*e));
  }

  template <class Visit>
  void visit_near(const EdgeSides& edge, const Visit& visit) const {
    const double west_m = west_of(edge) - on_line_m, east_m = east_of(edge) + on_line_m;
    auto e = std::lower_bound(edges_.begin(), edges_.end(), west_m - widest_m_,
                              [](const EdgeSides* other, double x) { return west_of(*other) < x; });
    for (; e != edges_.end() && west_of(**e) <= east_m; ++e)
      if (*e != &edge && east_of(**e) >= west_m && overlap(edge.edge(), (*e)->edge())) visit(**e);
  }

 private:
  static double west_of(const EdgeSides& e) { return std::min(e.edge().a.x, e.edge().b.x); }
  static double east_of(const EdgeSides& e) { return std::max(e.edge().a.x, e.edge().b.x); }
  static bool overlap(const Segment3d& s, const Segment3d& t) {
    const auto apart = [](double a, double b, double c, double d) {
      return std::max(a, b) + on_line_m < std::min(c, d) || std::max(c, d) + on_line_m < std::min(a, b);
    };
    return !apart(s.a.y, s.b.y, t.a.y, t.b.y) && !apart(s.a.z, s.b.z, t.a.z, t.b.z);
  }

  std::vector<const EdgeSides*> edges_;
  double widest_m_ = 0.0;
};

/// The parts of an edge at which it stays an underside when the facets of each other edge on the same line are added. Adds what
/// closes the cracks between both.
std::vector<ShareStretch> open_stretches(const EdgeSides& edge, const SortedEdges& closing_edges,
                                         std::vector<ClosingTriangle>& closing) {
  std::vector<SharedStretch> closed;
  closing_edges.visit_near(edge, [&](const EdgeSides& other) {
    EdgeSides both = edge;
    both.add_sides_of(other);
    if (both.can_be_underside()) return;
    if (const auto shared = shared_stretch(edge.edge(), other.edge())) closed.push_back(*shared);
  });
  // Cracks are where no edge is that meets this one
  const auto meets = [](const SharedStretch& s) { return s.distance_m <= least_crack_m; };
  const auto apart = std::stable_partition(closed.begin(), closed.end(), meets);
  std::vector<ShareStretch> open{{}};
  for (auto s = closed.begin(); s != closed.end(); ++s) {
    if (s >= apart)
      for (const ShareStretch& part : open) {
        const double from = std::max(part.from, s->stretch.from), to = std::min(part.to, s->stretch.to);
        if (from < to)
          close_crack({point_at(edge.edge(), from), point_at(edge.edge(), to)}, {s->other_at(from), s->other_at(to)}, closing);
      }
    open = without(open, s->stretch);
  }
  return open;
}

/// An edge that is not cut, in the frame of `cell`.
CellEdge whole_edge(const HorizonSegment& edge, Cell cell, const Grid& grid, double height_origin_m) {
  return {cell,
          {cell_from_grid(edge.segment.a, cell, grid, height_origin_m),
           cell_from_grid(edge.segment.b, cell, grid, height_origin_m), edge.adjacent, edge.role}};
}

}  // namespace

std::vector<ShareStretch> without(const std::vector<ShareStretch>& stretches, const ShareStretch& taken) {
  std::vector<ShareStretch> rest;
  for (const ShareStretch& s : stretches) {
    if (s.from < taken.from) rest.push_back({s.from, std::min(s.to, taken.from)});
    if (s.to > taken.to) rest.push_back({std::max(s.from, taken.to), s.to});
  }
  return rest;
}

std::vector<ShareStretch> without(std::vector<ShareStretch> stretches, const std::vector<ShareStretch>& taken) {
  for (const ShareStretch& s : taken) stretches = without(stretches, s);
  return stretches;
}

std::vector<ShareStretch> joined(std::vector<ShareStretch> stretches, double give) {
  std::sort(stretches.begin(), stretches.end(), [](const ShareStretch& a, const ShareStretch& b) { return a.from < b.from; });
  std::vector<ShareStretch> result;
  for (const ShareStretch& s : stretches)
    if (!result.empty() && s.from <= result.back().to + give)
      result.back().to = std::max(result.back().to, s.to);
    else
      result.push_back(s);
  return result;
}

std::vector<ShareStretch> tidied(std::vector<ShareStretch> stretches, double give) {
  stretches = joined(std::move(stretches), give);
  if (!stretches.empty() && stretches.front().from <= give) stretches.front().from = 0.0;
  if (!stretches.empty() && stretches.back().to >= 1.0 - give) stretches.back().to = 1.0;
  std::erase_if(stretches, [give](const ShareStretch& s) { return s.to - s.from <= give; });
  return stretches;
}

void EdgeSides::add(const Point3d& opposite, FacetLook look) {
  ++triangle_count_;
  const std::optional<UpperFacets::Facet> facet = upper_.add(edge_.a, edge_.b, opposite);
  if (!facet) return;
  // For undersides: a nearly vertical triangle closes the edge when it lies below, and has no effect when it rises
  if (std::abs(facet->aside_m) <= std::min(leaning_wall_z * std::abs(facet->rise_m), max_lean_m)) {
    over_wall_ |= facet->rise_m < 0.0;
    return;
  }
  double& low_rad = facet->aside_m > 0.0 ? left_low_rad_ : right_low_rad_;
  low_rad = std::min(low_rad, facet->rise_rad);
  (look == FacetLook::up ? has_roof_ : has_soffit_) = true;
}

void EdgeSides::add_sides_of(const EdgeSides& other) {
  // The other edge may run the opposite way: its left is then our right
  const Point2d along = horizontal(edge_.b - edge_.a), other_along = horizontal(other.edge_.b - other.edge_.a);
  const bool same_way = dot(along, other_along) >= 0.0;
  left_low_rad_ = std::min(left_low_rad_, same_way ? other.left_low_rad_ : other.right_low_rad_);
  right_low_rad_ = std::min(right_low_rad_, same_way ? other.right_low_rad_ : other.left_low_rad_);
  over_wall_ |= other.over_wall_;
  has_roof_ |= other.has_roof_;
  has_soffit_ |= other.has_soffit_;
  triangle_count_ += other.triangle_count_;
}

AdjacentSlopes EdgeSides::lowest_adjacent_slopes() const {
  constexpr double give_rad = 4.0 * slight_bend_rad;
  return {AdjacentSlopes::rounded_up(left_low_rad_ + give_rad), AdjacentSlopes::rounded_up(right_low_rad_ + give_rad)};
}

bool EdgeSides::counts_as_upright() const {
  const Point3d along = edge_.b - edge_.a;
  return norm(horizontal(along)) <= std::max(least_extent_m, std::min(leaning_wall_z * norm(along), max_lean_m));
}

bool EdgeSides::can_be_underside() const {
  // A vertical edge has no lower side, and a wall below the edge closes it
  if (counts_as_upright() || over_wall_) return false;
  // The lowest triangles on both sides bend upwards: below the edge there is no facet
  return left_low_rad_ + right_low_rad_ > slight_bend_rad && !is_valley();
}

bool EdgeSides::is_valley() const {
  return triangle_count_ > 1 && has_roof_ && !has_soffit_ && !over_wall_ && left_low_rad_ + right_low_rad_ > slight_bend_rad;
}

namespace {

std::uint64_t hash_of(const Segment3d& s) {
  // The multiplier of splitmix64 (Steele et al. 2014), so that the few bits in which neighbors differ reach all others
  std::uint64_t sum = 0;
  for (const double x : {s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z}) {
    sum = (sum ^ std::bit_cast<std::uint64_t>(x)) * 0xBF58476D1CE4E5B9U;
    sum ^= sum >> 31U;
  }
  return sum;
}

}  // namespace

/// The slot of the edge with these ends, or the free one where it belongs.
std::uint32_t& EdgeTable::slot_of(const Segment3d& key) {
  const std::size_t last = slots_.size() - 1;  // their number is a power of two
  std::size_t n = hash_of(key) & last;
  while (slots_[n] != no_edge && edges_[slots_[n]].edge() != key) n = (n + 1) & last;
  return slots_[n];
}

void EdgeTable::grow() {
  constexpr std::size_t least = 64;
  slots_.assign(std::max(least, std::bit_ceil(4 * edges_.size())), no_edge);
  for (std::uint32_t n = 0; n < edges_.size(); ++n) slot_of(edges_[n].edge()) = n;
}

void EdgeTable::add_edge(const Point3d& a, const Point3d& b, const Point3d& opposite, FacetLook look) {
  const Segment3d key = comes_first(a, b) ? Segment3d{a, b} : Segment3d{b, a};
  if (2 * (edges_.size() + 1) > slots_.size()) grow();
  std::uint32_t& slot = slot_of(key);
  if (slot == no_edge) {
    slot = static_cast<std::uint32_t>(edges_.size());
    edges_.emplace_back(key.a, key.b);
  }
  edges_[slot].add(opposite, look);
}

void EdgeTable::add_triangle(const Point3d& corner_a, const Point3d& corner_b, const Point3d& corner_c, FacetLook look) {
  const Point3d a = without_minus_zero(corner_a), b = without_minus_zero(corner_b), c = without_minus_zero(corner_c);
  add_edge(a, b, c, look);
  add_edge(b, c, a, look);
  add_edge(c, a, b, look);
}

std::vector<HorizonSegment> EdgeTable::horizon_edges() const {
  std::vector<HorizonSegment> result;
  for (const EdgeSides& e : edges_)
    if (e.can_be_horizon()) result.push_back({e.edge(), e.adjacent()});
  return result;
}

std::vector<HorizonSegment> undersides(std::span<const EdgeSides> edges, std::vector<ClosingTriangle>& closing) {
  // Collect the edges that can close another one: a facet continues below them
  std::vector<const EdgeSides*> with_facet_below;
  for (const EdgeSides& e : edges)
    if (e.has_facet_below()) with_facet_below.push_back(&e);
  const SortedEdges closing_edges(std::move(with_facet_below));
  // Keep the open parts of each underside
  std::vector<HorizonSegment> result;
  bool is_open = false;  // the building has a facet that ends in the air
  for (const EdgeSides& edge : edges) {
    if (!edge.can_be_underside()) continue;
    const double length_m = norm(edge.edge().b - edge.edge().a);
    for (const ShareStretch& s : open_stretches(edge, closing_edges, closing)) {
      if ((s.to - s.from) * length_m <= on_line_m) continue;
      is_open |= edge.triangle_count() == 1;
      result.push_back(
          {{point_at(edge.edge(), s.from), point_at(edge.edge(), s.to)}, edge.lowest_adjacent_slopes(), EdgeRole::underside});
    }
  }
  // Through an open border an eye may look up at the valleys of the roof from below
  if (is_open)
    for (const EdgeSides& edge : edges)
      if (edge.is_valley()) result.push_back({edge.edge(), edge.lowest_adjacent_slopes(), EdgeRole::underside});
  return result;
}

std::vector<CellEdge> cut_edge(const HorizonSegment& horizon, const Grid& grid, double height_origin_m) {
  const Segment3d& edge = horizon.segment;
  const Cell cell = grid.cell_of(horizontal(edge.a));
  if (cell == grid.cell_of(horizontal(edge.b))) return {whole_edge(horizon, cell, grid, height_origin_m)};
  // Shares of the edge at which it crosses a border
  std::vector<double> places{0.0, 1.0};
  add_crossings(edge.a.x, edge.b.x, grid, places);
  add_crossings(edge.a.y, edge.b.y, grid, places);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  // A piece between two crossings belongs to the cell of its midpoint
  std::vector<CellEdge> pieces;
  for (std::size_t n = 1; n < places.size(); ++n) {
    const Cell owner = grid.cell_of(horizontal(lerped(edge, 0.5 * (places[n - 1] + places[n]))));
    pieces.push_back(whole_edge({{lerped(edge, places[n - 1]), lerped(edge, places[n])}, horizon.adjacent, horizon.role}, owner,
                                grid, height_origin_m));
  }
  return pieces;
}

std::vector<CellEdge> cut_edge_unless_whole(const HorizonSegment& edge, const std::optional<Cell>& only_cell, const Grid& grid,
                                            double height_origin_m) {
  if (only_cell) return {whole_edge(edge, *only_cell, grid, height_origin_m)};
  return cut_edge(edge, grid, height_origin_m);
}

}  // namespace farlod::tiles
