// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/undersides.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace farlod {
namespace {

double distance_from_line_m(const Point3d& p, const Segment3d& s) {
  const Point3d along = s.b - s.a;
  return norm(cross(along, p - s.a)) / norm(along);
}

Point3d point_at(const Segment3d& s, double share) { return s.a + share * (s.b - s.a); }

/// A part of a segment, as shares of its way.
struct Stretch {
  double from = 0.0, to = 1.0;
};

/// The part of a segment along which another one runs.
std::optional<Stretch> shared_stretch(const Segment3d& s, const Segment3d& other) {
  const Point3d along = s.b - s.a;
  const double square = dot(along, along);
  const auto share_of = [&](const Point3d& p) { return dot(p - s.a, along) / square; };
  const auto [low, high] = std::minmax({share_of(other.a), share_of(other.b)});
  const Stretch shared{std::max(low, 0.0), std::min(high, 1.0)};
  if ((shared.to - shared.from) * std::sqrt(square) <= on_line_m) return std::nullopt;
  // Of a longer edge, what lies beside the segment counts alone
  const Point3d other_along = other.b - other.a;
  const auto on_other = [&](double share) {
    const double t = (share - share_of(other.a)) * square / dot(other_along, along);
    return point_at(other, std::clamp(t, 0.0, 1.0));
  };
  for (const double share : {shared.from, shared.to})
    if (distance_from_line_m(on_other(share), s) > on_line_m) return std::nullopt;
  return shared;
}

/// What is left of `stretches` without one.
std::vector<Stretch> without(const std::vector<Stretch>& stretches, const Stretch& taken) {
  std::vector<Stretch> rest;
  for (const Stretch& s : stretches) {
    if (s.from < taken.from) rest.push_back({s.from, std::min(s.to, taken.from)});
    if (s.to > taken.to) rest.push_back({std::max(s.from, taken.to), s.to});
  }
  return rest;
}

/// Edges in the order of where they begin along x.
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

/// The parts of an edge below which no other edge on the same line goes on.
std::vector<Stretch> open_stretches(const EdgeSides& edge, const SortedEdges& closing) {
  std::vector<Stretch> open{{}};
  closing.visit_near(edge, [&](const EdgeSides& other) {
    if (open.empty()) return;
    EdgeSides both = edge;
    both.add_sides_of(other);
    if (both.can_be_underside()) return;
    if (const auto shared = shared_stretch(edge.edge(), other.edge())) open = without(open, *shared);
  });
  return open;
}

}  // namespace

std::vector<HorizonSegment> undersides(std::span<const EdgeSides> edges) {
  std::vector<const EdgeSides*> closing;
  for (const EdgeSides& e : edges)
    if (e.has_facet_below()) closing.push_back(&e);
  const SortedEdges closing_edges(std::move(closing));
  std::vector<HorizonSegment> result;
  bool is_open = false;
  for (const EdgeSides& edge : edges) {
    if (!edge.can_be_underside()) continue;
    const double length_m = norm(edge.edge().b - edge.edge().a);
    for (const Stretch& s : open_stretches(edge, closing_edges)) {
      if ((s.to - s.from) * length_m <= on_line_m) continue;
      is_open |= edge.triangle_count() == 1;
      result.push_back({{point_at(edge.edge(), s.from), point_at(edge.edge(), s.to)}, edge.lowest_adjacent_slopes(), EdgeRole::underside});
    }
  }
  // Where a sheet ends, one may look below it at the valleys of a roof
  if (is_open)
    for (const EdgeSides& edge : edges)
      if (edge.is_valley()) result.push_back({edge.edge(), edge.lowest_adjacent_slopes(), EdgeRole::underside});
  return result;
}

}  // namespace farlod
