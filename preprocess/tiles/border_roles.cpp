// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/border_roles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/ground_contact.hpp"
#include "city/geometry.hpp"
#include "tiles/facet_triangulation.hpp"
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

/// The stretch of `s` that lies right below `other`, on one line in the plan, and at least so far.
std::optional<ShareStretch> stretch_below(const Segment3d& s, const Segment3d& other, double least_m = on_line_m) {
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
    return std::lerp(s.a.z, s.b.z, at) < other_m - least_m;
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

using Stretches = std::vector<ShareStretch>;

/// Adds the stretches of a border. Its own ends stay exact: other borders begin there.
void add_parts(const HorizonSegment& border, const Stretches& stretches, std::vector<HorizonSegment>& result) {
  const Segment3d& s = border.segment;
  for (const ShareStretch& t : stretches)
    if ((t.from == 0.0 && t.to == 1.0) || (t.to - t.from) * norm(s.b - s.a) > least_sliver_m)
      result.push_back(
          {{t.from == 0.0 ? s.a : point_at(s, t.from), t.to == 1.0 ? s.b : point_at(s, t.to)}, border.adjacent, border.role});
}

/// The borders that hide all below them.
SortedSegments grounded_of(const std::vector<UpperBorder>& borders) {
  std::vector<Segment3d> grounded;
  for (const UpperBorder& border : borders)
    if (border.segment.role == EdgeRole::grounded) grounded.push_back(border.segment.segment);
  return SortedSegments(std::move(grounded));
}

/// Adds the parts of a border that do not lie right below one of others.
void add_seen_parts(const HorizonSegment& border, const SortedSegments& hiding, std::vector<HorizonSegment>& result) {
  Stretches seen{{}};
  hiding.visit_near(border.segment, [&](const Segment3d& other) {
    if (const auto hidden = stretch_below(border.segment, other)) seen = without(seen, *hidden);
  });
  add_parts(border, seen, result);
}

std::vector<UpperBorder> without_those_below_grounded(const std::vector<UpperBorder>& borders) {
  const SortedSegments hiding = grounded_of(borders);
  std::vector<UpperBorder> result;
  std::vector<HorizonSegment> parts;
  for (const UpperBorder& border : borders) {
    parts.clear();
    add_seen_parts(border.segment, hiding, parts);
    for (const HorizonSegment& part : parts) result.push_back({part, border.by_wall});
  }
  return result;
}

/// Where borders that are not grounded end.
class OverhangEnds {
 public:
  explicit OverhangEnds(const std::vector<UpperBorder>& borders) {
    for (const UpperBorder& border : borders) {
      const auto& [a, b] = border.segment.segment;
      if (border.segment.role != EdgeRole::overhang) continue;
      ends_.push_back({a, horizontal(b - a)});
      ends_.push_back({b, horizontal(a - b)});
    }
    std::sort(ends_.begin(), ends_.end(), [](const End& e, const End& f) { return comes_first(e.place, f.place); });
  }
  /// Whether the corner leans in below such a border: at some azimuths, what is below the border's end ends on the corner.
  [[nodiscard]] bool overhang(const Segment3d& corner) const {
    const auto comes_before = [](const End& e, const Point3d& p) { return comes_first(e.place, p); };
    const Point2d lean = horizontal(corner.b - corner.a);
    auto end = std::lower_bound(ends_.begin(), ends_.end(), corner.a, comes_before);
    for (; end != ends_.end() && end->place == corner.a; ++end)
      if (dot(lean, end->inward) > least_sliver_m * norm(end->inward)) return true;
    return false;
  }

 private:
  struct End {
    Point3d place;
    Point2d inward;  ///< the way along the border
  };
  std::vector<End> ends_;
};

/// The lower borders at corners, each at the height of its upper end. Where one ends, the next one below it goes on.
/// They are taken out of the corners.
std::vector<HorizonSegment> take_lower_borders(std::vector<LeaningCorner>& corners, const std::vector<UpperBorder>& borders) {
  constexpr AdjacentSlopes straight_up{AdjacentSlopes::straight_up, AdjacentSlopes::straight_up};
  std::stable_sort(corners.begin(), corners.end(),
                   [](const LeaningCorner& c, const LeaningCorner& d) { return c.segment.a.z > d.segment.a.z; });
  const OverhangEnds ends(borders);
  Places feet(&comes_first);
  std::vector<HorizonSegment> result;
  std::vector<LeaningCorner> rest;
  for (const LeaningCorner& corner : corners) {
    const auto& [top, foot] = corner.segment;
    if (!ends.overhang(corner.segment) && !feet.contains(top)) {
      rest.push_back(corner);
      continue;
    }
    feet.insert(foot);
    result.push_back({{top, {foot.x, foot.y, top.z}}, straight_up, EdgeRole::underside});
  }
  corners = std::move(rest);
  return result;
}

Places ends_of_grounded(const std::vector<UpperBorder>& borders) {
  std::vector<HorizonSegment> grounded;
  for (const UpperBorder& border : borders)
    if (border.segment.role == EdgeRole::grounded) grounded.push_back(border.segment);
  return ends_of(grounded);
}

/// What a building's inside, and its walls, tell of its upper borders.
class BorderRoles {
 public:
  BorderRoles(const BuildingPieces& building, const GroundedWalls& walls)
      // Without slabs, nothing is known of the inside: most buildings need none
      : solid_(building.loose_edges.empty() ? std::span<const Slab>(building.slabs) : std::span<const Slab>()),
        walled_in_(building.slabs.empty() ? std::span<const WallProfile>() : walls.walls(), building.slabs,
                   building.loose_edges) {}

  /// A border, and what is known of it.
  struct Known {
    HorizonSegment border;
    SolidToGround::Parts parts;
  };
  void add(const HorizonSegment& border) {
    Known& known = known_.emplace_back(Known{border, solid_.parts_of(border.segment, recesses_)});
    const Stretches within = walled_in_.stretches_of(border.segment);
    known.parts.grounded.insert(known.parts.grounded.end(), within.begin(), within.end());
  }
  /// Eyes in a recess must have its borders near them: those of a building that is not cut may be far.
  void leave_recesses_open() { recesses_.clear(); }

  [[nodiscard]] std::vector<HorizonSegment> outside_of_solid(const HorizonSegment& underside) const {
    std::vector<HorizonSegment> parts;
    add_parts(underside, without({ShareStretch{}}, solid_.buried_parts_of(underside.segment)), parts);
    return parts;
  }
  /// Adds the parts of all borders with their roles.
  void find(std::vector<UpperBorder>& result) const {
    for (const auto& [border, parts] : known_) {
      Stretches grounded = parts.grounded;
      for (const ShareStretch& hollow : parts.hollow) add_over_recesses(border.segment, hollow, grounded);
      const double length_m = norm(border.segment.b - border.segment.a);
      grounded = tidied(std::move(grounded), least_sliver_m / length_m);
      std::vector<HorizonSegment> of_border;
      HorizonSegment with_role = border;
      with_role.role = EdgeRole::grounded;
      add_parts(with_role, without(grounded, parts.buried), of_border);
      with_role.role = EdgeRole::overhang;
      add_parts(with_role, without(without({ShareStretch{}}, grounded), parts.buried), of_border);
      for (const HorizonSegment& part : of_border) result.push_back({part});
    }
  }

 private:
  void add_over_recesses(const Segment3d& border, const ShareStretch& hollow, Stretches& grounded) const {
    for (const SolidToGround::Recess& recess : recesses_)
      if (const auto over = recess.stretch_over(border)) {
        const ShareStretch both{std::max(hollow.from, over->from), std::min(hollow.to, over->to)};
        if (both.to > both.from) grounded.push_back(both);
      }
  }

  SolidToGround solid_;
  WalledIn walled_in_;
  std::vector<Known> known_;
  std::vector<SolidToGround::Recess> recesses_;
};

bool is_upright(const CityModel& city, const Facet& facet) {
  const std::span<const Point3d> outer = city.ring(facet, 0);
  const Point3d area_vector_m2 = area_vector({&outer, 1});
  const double area_m2 = norm(area_vector_m2);
  return area_m2 > 0.0 && std::abs(area_vector_m2.z) <= leaning_wall_z * area_m2;
}

/// Whether all edges of an upright facet lie on borders, or right below them. An upright edge ends where others begin.
bool lies_below(const SortedSegments& borders, const CityModel& city, const Facet& facet) {
  for (std::uint32_t r = 0; r < facet.ring_count; ++r) {
    const std::span<const Point3d> ring = city.ring(facet, r);
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const Segment3d edge{ring[n], ring[(n + 1) % ring.size()]};
      const double run_m = norm(horizontal(edge.b - edge.a));
      if (run_m <= on_line_m) continue;
      Stretches above{{}};
      borders.visit_near(edge, [&](const Segment3d& border) {
        if (const auto below = stretch_below(edge, border, -on_line_m)) above = without(above, *below);
      });
      const auto is_long = [&](const ShareStretch& s) { return (s.to - s.from) * run_m > on_line_m; };
      if (std::any_of(above.begin(), above.end(), is_long)) return false;
    }
  }
  return true;
}

}  // namespace

BordersWithRoles borders_with_roles(BuildingPieces& building, const std::vector<HorizonSegment>& undersides,
                                    const GroundHeightAt& ground_height) {
  const GroundedWalls walls(*std::exchange(building.walls, std::nullopt), ground_height);
  for (Slab& slab : building.slabs) slab.on_ground = slab.on_ground || stands_on_ground(slab, ground_height);
  BorderRoles roles(building, walls);
  BordersWithRoles result;
  for (const HorizonSegment& border : building.upper_borders)
    if (walls.close_below(border.segment))
      result.upper.push_back({border, true});
    else
      roles.add(border);
  if (building.only_cell) roles.leave_recesses_open();
  roles.find(result.upper);
  result.upper = without_those_below_grounded(result.upper);
  result.corners = take_lower_borders(building.corners, result.upper);
  result.closing = closing_below(std::move(building.corners), ends_of_grounded(result.upper), ground_height);
  const SortedSegments hiding = grounded_of(result.upper);
  for (const HorizonSegment& underside : undersides)
    for (const HorizonSegment& part : roles.outside_of_solid(underside)) add_seen_parts(part, hiding, result.undersides);
  building.slabs = {};
  return result;
}

NumbersOfWalls walls_of(const CityModel& city_grid, const Building& building, const std::vector<UpperBorder>& borders) {
  std::vector<Segment3d> of_walls;
  for (const UpperBorder& border : borders)
    if (border.by_wall) of_walls.push_back(border.segment.segment);
  const SortedSegments hiding(std::move(of_walls));
  const bool all_grounded =
      std::all_of(borders.begin(), borders.end(), [](const UpperBorder& b) { return b.segment.role == EdgeRole::grounded; });
  struct Known {
    bool is_wall = true, is_hidden = true;
  };
  std::map<std::uint32_t, Known> surfaces;
  for (const Facet& facet : city_grid.facets_of(building)) {
    Known& surface = surfaces[facet.surface];
    surface.is_wall = surface.is_wall && is_upright(city_grid, facet);
    surface.is_hidden = surface.is_hidden && surface.is_wall && lies_below(hiding, city_grid, facet);
  }
  NumbersOfWalls walls;
  for (const auto& [number, surface] : surfaces) {
    if (!surface.is_wall) continue;
    walls.all.push_back(number);
    if (all_grounded || surface.is_hidden) walls.hidden.push_back(number);
  }
  return walls;
}

void tell_what_overhangs(std::span<Surface> surfaces, const std::vector<std::uint32_t>& walls) {
  for (Surface& s : surfaces) s.grounded = std::binary_search(walls.begin(), walls.end(), s.number);
}

void add_ends(const std::vector<ClosingTriangle>& closing, std::vector<UpperBorder>& borders) {
  constexpr double longest_m = 2.0 * contact_m;
  // Each border computes its ends by itself
  const auto order = [](const Point3d& p) {
    const auto rounded = [](double m) { return std::llround(m * 1e4); };
    return std::tuple(rounded(p.x), rounded(p.y), rounded(p.z));
  };
  const auto order_of_side = [&](const Segment3d& s) { return std::tuple_cat(order(s.a), order(s.b)); };
  std::vector<Segment3d> sides;
  for (const ClosingTriangle& t : closing)
    for (std::size_t n = 0; n < t.size(); ++n) {
      const auto [a, b] =
          std::minmax(t[n], t[(n + 1) % t.size()], [&](const auto& p, const auto& q) { return order(p) < order(q); });
      if (norm(b - a) <= longest_m) sides.push_back({a, b});
    }
  std::ranges::sort(sides, {}, order_of_side);
  // Where the next triangle goes on is no end
  for (auto side = sides.begin(); side != sides.end();) {
    const auto next =
        std::find_if(side, sides.end(), [&](const Segment3d& s) { return order_of_side(s) != order_of_side(*side); });
    // It has no sides that would hide it from some eyes
    if (next - side == 1) borders.push_back({{*side, {}, EdgeRole::overhang}});
    side = next;
  }
}

std::vector<HorizonSegment> placed_borders(const std::vector<UpperBorder>& borders, bool has_undersides) {
  std::vector<UpperBorder> grounded = borders;
  if (!has_undersides) {
    for (UpperBorder& border : grounded) border.segment.role = EdgeRole::grounded;
    grounded = without_those_below_grounded(grounded);
  }
  std::vector<HorizonSegment> result;
  for (const UpperBorder& border : grounded) {
    result.push_back(border.segment);
    if (has_undersides && border.by_wall) result.back().adjacent = {};
  }
  return result;
}

}  // namespace farlod::tiles
