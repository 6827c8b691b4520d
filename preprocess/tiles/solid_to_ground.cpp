// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/solid_to_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/contacts.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {
namespace {

/// Where sides of triangles meet, rounding leaves stretches that are no longer.
constexpr double least_stretch_m = 1e-6;

/// Columns are looked at so far beside an edge: more than the rounding of files.
constexpr double beside_m = 0.005;

Box2d box_of(Point2d a, Point2d b) {
  Box2d box;
  box.add(a);
  box.add(b);
  return box;
}

/// What both hold.
std::vector<ShareStretch> common(std::vector<ShareStretch> one, const std::vector<ShareStretch>& other) {
  return without(tidied(std::move(one), 0.0), without({ShareStretch{}}, other));
}

/// The part of a convex polygon where x·normal ≤ limit.
std::vector<Point2d> clipped(const std::vector<Point2d>& polygon, Point2d normal, double limit) {
  std::vector<Point2d> rest;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Point2d &p = polygon[n], &q = polygon[(n + 1) % polygon.size()];
    const double beyond_p = dot(p, normal) - limit, beyond_q = dot(q, normal) - limit;
    if (beyond_p <= 0.0) rest.push_back(p);
    if ((beyond_p < 0.0 && beyond_q > 0.0) || (beyond_p > 0.0 && beyond_q < 0.0))
      rest.push_back(p + (beyond_p / (beyond_p - beyond_q)) * (q - p));
  }
  return rest;
}

double area_m2(const std::vector<Point2d>& polygon) {
  double twice = 0.0;
  for (std::size_t n = 2; n < polygon.size(); ++n) twice += across(polygon[n - 1] - polygon[0], polygon[n] - polygon[0]);
  return 0.5 * std::abs(twice);
}

}  // namespace

template <class Visit>
void SolidToGround::visit_near(const Box2d& box, const Visit& visit) const {
  auto slab = std::lower_bound(slabs_.begin(), slabs_.end(), box.low.x - widest_m_,
                               [](const Placed& s, double x) { return s.plan.low.x < x; });
  for (; slab != slabs_.end() && slab->plan.low.x <= box.high.x; ++slab)
    if (boxes_meet(slab->plan, box)) visit(*slab);
}

/// An edge and one of its sides in the plan: x runs along the edge, y away from it.
class SolidToGround::Beside {
 public:
  Beside(const Segment3d& edge, double side, const SolidToGround& solid)
      : solid_(solid), edge_(edge), begin_(horizontal(edge.a)), run_m_(norm(horizontal(edge.b - edge.a))) {
    along_ = (1.0 / run_m_) * horizontal(edge.b - edge.a);
    aside_ = side * Point2d{-along_.y, along_.x};
    solid_.visit_near(box_of(begin_, horizontal(edge.b)), [&](const Placed& slab) {
      if (has_edge(slab, edge) && is_on_this_side(slab)) top_ = &slab;
    });
  }

  /// Adds what the columns on this side tell, and the recesses below the edge.
  void find(Parts& parts, std::vector<ShareStretch>& buried, std::vector<Recess>& recesses) const {
    std::vector<Hollow> hollows;
    const Level above = above_edge(contact_m);
    visit_columns_beside(above, [&](const ShareStretch& s, const Column& column) {
      const double share = 0.5 * (s.from + s.to);
      if (is_inside(column, above.at(share))) buried.push_back(s);
      if (top_ == nullptr) return;
      const double top_m = top_->slab.height_m(place({share * run_m_, 2.0 * std::min(share, 1.0 - share) * beside_m}));
      if (!on_surface(column, top_m)) return;
      if (solid_up_to_m(column) >= top_m - on_line_m)
        parts.grounded.push_back(s);
      else
        add_hollow({s.from * run_m_, s.to * run_m_, depth_m(column)}, hollows);
    });
    for (Hollow& hollow : hollows) {
      if (hollow.to_m - hollow.from_m <= on_line_m) continue;
      parts.hollow.push_back({hollow.from_m / run_m_, hollow.to_m / run_m_});
      extend(hollow);
      if (const auto recess = recess_of(hollow)) recesses.push_back(*recess);
    }
  }
  /// The stretches with the solid on this side, above and below.
  [[nodiscard]] std::vector<ShareStretch> within_solid() const {
    const auto within = [&](const Level& level) {
      std::vector<ShareStretch> stretches;
      visit_columns_beside(level, [&](const ShareStretch& s, const Column& column) {
        if (is_inside(column, level.at(0.5 * (s.from + s.to)))) stretches.push_back(s);
      });
      return stretches;
    };
    return common(within(above_edge(-contact_m)), within(above_edge(contact_m)));
  }

 private:
  /// Where a vertical line meets the slabs, from below.
  struct Crossing {
    double z_m;
    const Placed* slab;
  };
  using Column = std::vector<Crossing>;

  static bool on_surface(const Column& column, double z_m) {
    return std::any_of(column.begin(), column.end(), [z_m](const Crossing& c) { return std::abs(c.z_m - z_m) <= on_line_m; });
  }
  static bool is_inside(const Column& column, double z_m) {
    int above = 0;
    for (const Crossing& c : column)
      if (c.z_m > z_m) above += c.slab->slab.look == FacetLook::up ? 1 : -1;
    return above > 0;
  }
  /// The height up to which the line is in the solid without a break, from the ground on.
  static double solid_up_to_m(const Column& column) {
    double top_m = -std::numeric_limits<double>::infinity();
    int depth = 0;
    for (const Crossing& c : column) {
      const bool looks_up = c.slab->slab.look == FacetLook::up;
      if (depth == 0 && looks_up && c.slab->slab.on_ground) continue;
      if (depth == 0 && (looks_up || !(c.slab->slab.on_ground || c.z_m <= top_m + contact_m))) break;
      depth += looks_up ? -1 : 1;
      if (depth == 0) top_m = c.z_m;
    }
    return depth == 0 ? top_m : -std::numeric_limits<double>::infinity();
  }

  /// A part of the line of the edge below which the solid is hollow, and how far the ceilings there reach inwards.
  struct Hollow {
    double from_m = 0.0, to_m = 0.0, depth_m = 0.0;
  };
  static void add_hollow(const Hollow& hollow, std::vector<Hollow>& hollows) {
    if (hollows.empty() || hollow.from_m - hollows.back().to_m > least_sliver_m) return hollows.push_back(hollow);
    hollows.back().to_m = hollow.to_m;
    hollows.back().depth_m = std::max(hollows.back().depth_m, hollow.depth_m);
  }
  [[nodiscard]] double depth_m(const Column& column) const {
    double depth_m = 0.0;
    for (const Crossing& c : column)
      if (is_ceiling(c.slab->slab))
        for (const Point3d& p : c.slab->slab.corners) depth_m = std::max(depth_m, seen(p).y);
    return depth_m;
  }
  /// Lengthens what is hollow up to the ends of the edge as far as it goes on beyond them.
  void extend(Hollow& hollow) const {
    const auto go_on = [&](double from_m, double to_m) {
      double end_m = from_m;
      bool is_hollow = true;
      visit_columns({from_m, beside_m}, {to_m, beside_m}, {}, [&](const ShareStretch& s, const Column& column) {
        is_hollow = is_hollow && !column.empty() && solid_up_to_m(column) < column.back().z_m - on_line_m;
        if (!is_hollow) return;
        end_m = std::lerp(from_m, to_m, s.to);
        hollow.depth_m = std::max(hollow.depth_m, depth_m(column));
      });
      return end_m;
    };
    if (hollow.from_m <= least_sliver_m) hollow.from_m = go_on(0.0, -most_recess_extent_m);
    if (hollow.to_m >= run_m_ - least_sliver_m) hollow.to_m = go_on(run_m_, run_m_ + most_recess_extent_m);
  }
  [[nodiscard]] std::optional<Recess> recess_of(const Hollow& hollow) const {
    const double depth_m = hollow.depth_m + beside_m;
    Recess recess{begin_, along_, aside_, {{hollow.from_m - beside_m, beside_m}, {hollow.to_m + beside_m, depth_m}}};
    const auto& [low, high] = recess.plan;
    if (depth_m > most_recess_depth_m || norm(high - low) > most_recess_extent_m) return std::nullopt;
    const std::optional<double> layer_m = height_of_layer_m(recess);
    if (!layer_m) return std::nullopt;
    recess.layer_m = *layer_m;
    const std::array<Point2d, 4> corners{low, {low.x, high.y}, high, {high.x, low.y}};
    bool is_closed = true;
    for (std::size_t n = 1; n < corners.size(); ++n)
      visit_columns(corners[n - 1], corners[n], {*layer_m, *layer_m}, [&](const ShareStretch&, const Column& column) {
        is_closed = is_closed && solid_up_to_m(column) >= *layer_m;
      });
    return is_closed ? std::optional(recess) : std::nullopt;
  }
  /// A height between the ceilings of a recess and the roofs that cover it; nothing if there is none.
  [[nodiscard]] std::optional<double> height_of_layer_m(const Recess& recess) const {
    double ceiling_m = -std::numeric_limits<double>::infinity();
    visit_parts_in(recess, [&](const Slab& slab, const std::vector<Point2d>& part) {
      if (is_ceiling(slab)) ceiling_m = std::max(ceiling_m, heights(slab, part).second);
    });
    double roof_m = std::numeric_limits<double>::infinity(), covered_m2 = 0.0;
    visit_parts_in(recess, [&](const Slab& slab, const std::vector<Point2d>& part) {
      const auto [low_m, high_m] = heights(slab, part);
      if (slab.look == FacetLook::down || high_m <= ceiling_m) return;  // what looks up may be a sill
      roof_m = std::min(roof_m, low_m);
      covered_m2 += area_m2(part);
    });
    constexpr double all = 1.0 - 1e-6;
    const Point2d extent = recess.plan.high - recess.plan.low;
    const double layer_m = ceiling_m + contact_m;
    if (!std::isfinite(layer_m) || roof_m < layer_m || covered_m2 < all * extent.x * extent.y) return std::nullopt;
    return layer_m;
  }
  /// The least and the largest height of a slab over a part of the plan.
  [[nodiscard]] std::pair<double, double> heights(const Slab& slab, const std::vector<Point2d>& part) const {
    std::pair range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Point2d p : part) {
      const double z_m = slab.height_m(place(p));
      range = {std::min(range.first, z_m), std::max(range.second, z_m)};
    }
    return range;
  }
  /// Calls `visit(slab, part)` for the part of each slab in the plan of a recess.
  template <class Visit>
  void visit_parts_in(const Recess& recess, const Visit& visit) const {
    const Point2d low = recess.plan.low, high = recess.plan.high;
    Box2d box = box_of(place(low), place(high));
    box.add(place({low.x, high.y}));
    box.add(place({high.x, low.y}));
    solid_.visit_near(box, [&](const Placed& slab) {
      std::vector<Point2d> part;
      for (const Point3d& p : slab.slab.corners) part.push_back(seen(p));
      part = clipped(clipped(part, {1.0, 0.0}, high.x), {-1.0, 0.0}, -low.x);
      part = clipped(clipped(part, {0.0, 1.0}, high.y), {0.0, -1.0}, -low.y);
      if (part.size() >= 3) visit(slab.slab, part);
    });
  }
  static bool is_ceiling(const Slab& slab) { return slab.look == FacetLook::down && !slab.on_ground; }

  [[nodiscard]] Point2d place(Point2d p) const { return begin_ + p.x * along_ + p.y * aside_; }
  [[nodiscard]] Point2d seen(const Point3d& p) const {
    return {dot(horizontal(p) - begin_, along_), dot(horizontal(p) - begin_, aside_)};
  }
  [[nodiscard]] bool is_on_this_side(const Placed& slab) const {
    const auto& c = slab.slab.corners;
    return std::any_of(c.begin(), c.end(), [&](const Point3d& p) { return dot(horizontal(p) - begin_, aside_) > beside_m; });
  }
  static bool has_edge(const Placed& slab, const Segment3d& edge) {
    const auto& c = slab.slab.corners;
    return std::find(c.begin(), c.end(), edge.a) != c.end() && std::find(c.begin(), c.end(), edge.b) != c.end();
  }

  /// A height above each place of a way: it rises evenly from the first end to the second.
  struct Level {
    double from_m = 0.0, to_m = 0.0;
    [[nodiscard]] double at(double share) const { return std::lerp(from_m, to_m, share); }
  };
  /// A slab that a way meets.
  struct Met {
    ShareStretch stretch;
    Level level;
    const Placed* slab = nullptr;
  };
  /// Adds the place where one level comes to be above another, if there is one in a stretch.
  static void add_crossing(const Level& one, const Level& other, const ShareStretch& within, std::vector<double>& places) {
    const double from_m = one.from_m - other.from_m, to_m = one.to_m - other.to_m;
    if (!((from_m < 0.0 && to_m > 0.0) || (from_m > 0.0 && to_m < 0.0))) return;
    const double place = from_m / (from_m - to_m);
    if (within.from < place && place < within.to) places.push_back(place);
  }
  /// The places of a way between which columns meet the same slabs in the same order, of which the same are above the level and
  /// in contact with each other.
  static std::vector<double> places_of(const std::vector<Met>& met, const Level& level) {
    std::vector<double> places{0.0, 1.0};
    for (std::size_t n = 0; n < met.size(); ++n) {
      const auto& [stretch, own, slab] = met[n];
      places.insert(places.end(), {stretch.from, stretch.to});
      add_crossing(own, level, stretch, places);
      for (std::size_t k = 0; k < met.size(); ++k) {
        const ShareStretch both{std::max(stretch.from, met[k].stretch.from), std::min(stretch.to, met[k].stretch.to)};
        if (k == n || !(both.to > both.from)) continue;
        if (k < n) add_crossing(own, met[k].level, both, places);
        add_crossing({own.from_m + contact_m, own.to_m + contact_m}, met[k].level, both, places);
      }
    }
    std::sort(places.begin(), places.end());
    return places;
  }
  /// The columns beside the edge, as below: from its first end to a place beside its middle, and on to its other end, so that
  /// what leans at a corner is seen there.
  template <class Visit>
  void visit_columns_beside(const Level& level, const Visit& visit) const {
    const double middle_m = level.at(0.5);
    const Point2d middle{0.5 * run_m_, beside_m};
    visit_columns({0.0, 0.0}, middle, {level.from_m, middle_m}, [&](const ShareStretch& s, const Column& column) {
      visit(ShareStretch{0.5 * s.from, 0.5 * s.to}, column);
    });
    visit_columns(middle, {run_m_, 0.0}, {middle_m, level.to_m}, [&](const ShareStretch& s, const Column& column) {
      visit(ShareStretch{0.5 + 0.5 * s.from, 0.5 + 0.5 * s.to}, column);
    });
  }
  /// The columns along a way, one for each stretch of it, as they are in its middle: what they tell of the level is the same in
  /// all of the stretch.
  template <class Visit>
  void visit_columns(Point2d from_beside, Point2d to_beside, const Level& level, const Visit& visit) const {
    const Point2d from = place(from_beside), to = place(to_beside);
    std::vector<Met> met;
    solid_.visit_near(box_of(from, to), [&](const Placed& slab) {
      if (const auto stretch = part_within(slab.slab, from, to))
        met.push_back({*stretch, {slab.slab.height_m(from), slab.slab.height_m(to)}, &slab});
    });
    const std::vector<double> places = places_of(met, level);
    Column column;
    const double length_m = norm(to - from);
    for (std::size_t n = 1; n < places.size(); ++n) {
      if (!((places[n] - places[n - 1]) * length_m > least_stretch_m)) continue;
      const double middle = 0.5 * (places[n - 1] + places[n]);
      column.clear();
      for (const auto& [stretch, own, slab] : met)
        if (stretch.from <= middle && middle <= stretch.to) column.push_back({own.at(middle), slab});
      std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.z_m < b.z_m; });
      visit(ShareStretch{places[n - 1], places[n]}, column);
    }
  }
  /// So far above the edge.
  [[nodiscard]] Level above_edge(double height_m) const { return {edge_.a.z + height_m, edge_.b.z + height_m}; }

  const SolidToGround& solid_;
  const Placed* top_ = nullptr;  ///< the facet on this side of the edge
  Segment3d edge_;
  Point2d begin_, along_, aside_;
  double run_m_;
};

SolidToGround::SolidToGround(std::span<const Slab> slabs) {
  slabs_.reserve(slabs.size());
  for (const Slab& slab : slabs) {
    Placed& placed = slabs_.emplace_back(Placed{slab, {}});
    for (const Point3d& p : slab.corners) placed.plan.add(horizontal(p));
    widest_m_ = std::max(widest_m_, placed.plan.high.x - placed.plan.low.x);
  }
  std::stable_sort(slabs_.begin(), slabs_.end(), [](const Placed& a, const Placed& b) { return a.plan.low.x < b.plan.low.x; });
}

SolidToGround::Parts SolidToGround::parts_of(const Segment3d& edge, std::vector<Recess>& recesses) const {
  const double run_m = norm(horizontal(edge.b - edge.a));
  if (slabs_.empty() || run_m <= contact_m) return {};
  Parts parts;
  std::vector<ShareStretch> buried_left, buried_right;
  Beside(edge, 1.0, *this).find(parts, buried_left, recesses);
  Beside(edge, -1.0, *this).find(parts, buried_right, recesses);
  parts.grounded = tidied(std::move(parts.grounded), least_sliver_m / run_m);
  parts.buried = common(std::move(buried_left), buried_right);
  return parts;
}

std::vector<ShareStretch> SolidToGround::buried_parts_of(const Segment3d& underside) const {
  if (slabs_.empty() || norm(horizontal(underside.b - underside.a)) <= contact_m) return {};
  return common(Beside(underside, 1.0, *this).within_solid(), Beside(underside, -1.0, *this).within_solid());
}

std::optional<ShareStretch> SolidToGround::Recess::stretch_over(const Segment3d& edge) const {
  ShareStretch over;
  const auto limit = [&](double from, double to, double most) {
    if (from > most && to > most) over.to = -1.0;
    if (from > most && to <= most) over.from = std::max(over.from, (from - most) / (from - to));
    if (from <= most && to > most) over.to = std::min(over.to, (most - from) / (to - from));
  };
  const Point2d a = horizontal(edge.a) - begin, b = horizontal(edge.b) - begin;
  limit(dot(a, along), dot(b, along), plan.high.x);
  limit(-dot(a, along), -dot(b, along), -plan.low.x);
  limit(dot(a, aside), dot(b, aside), plan.high.y);
  limit(-dot(a, aside), -dot(b, aside), on_line_m);  // its open side is the line of an edge
  limit(-edge.a.z, -edge.b.z, -layer_m);
  return over.to > over.from ? std::optional(over) : std::nullopt;
}

}  // namespace farlod::tiles
