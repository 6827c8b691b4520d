// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/solid_to_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {
namespace {

/// Columns are looked at so far beside an edge: more than the rounding of files.
constexpr double beside_m = 0.005;

Box2d box_of(Point2d a, Point2d b) {
  Box2d box;
  box.add(a);
  box.add(b);
  return box;
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

  /// Adds the grounded stretches, and those above which the solid lies on this side.
  void find(std::vector<ShareStretch>& grounded, std::vector<ShareStretch>& buried) const {
    visit_columns({0.0, beside_m}, {run_m_, beside_m}, [&](const ShareStretch& s, const Column& column) {
      const double share = 0.5 * (s.from + s.to), edge_m = std::lerp(edge_.a.z, edge_.b.z, share);
      if (is_inside(column, edge_m + contact_m)) buried.push_back(s);
      if (top_ == nullptr) return;
      const double top_m = top_->slab.height_m(place({share * run_m_, beside_m}));
      if (on_surface(column, top_m) && solid_up_to_m(column) >= top_m - on_line_m) grounded.push_back(s);
    });
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

  [[nodiscard]] Point2d place(Point2d p) const { return begin_ + p.x * along_ + p.y * aside_; }
  [[nodiscard]] bool is_on_this_side(const Placed& slab) const {
    const auto& c = slab.slab.corners;
    return std::any_of(c.begin(), c.end(), [&](const Point3d& p) { return dot(horizontal(p) - begin_, aside_) > beside_m; });
  }
  static bool has_edge(const Placed& slab, const Segment3d& edge) {
    const auto& c = slab.slab.corners;
    return std::find(c.begin(), c.end(), edge.a) != c.end() && std::find(c.begin(), c.end(), edge.b) != c.end();
  }

  /// The columns along a way, one for each stretch of it that meets the same slabs, as they are in its middle.
  template <class Visit>
  void visit_columns(Point2d from_beside, Point2d to_beside, const Visit& visit) const {
    const Point2d from = place(from_beside), to = place(to_beside);
    std::vector<std::pair<ShareStretch, const Placed*>> met;
    std::vector<double> places{0.0, 1.0};
    solid_.visit_near(box_of(from, to), [&](const Placed& slab) {
      const auto stretch = part_within(slab.slab, from, to);
      if (!stretch) return;
      met.emplace_back(*stretch, &slab);
      places.insert(places.end(), {stretch->from, stretch->to});
    });
    std::sort(places.begin(), places.end());
    Column column;
    for (std::size_t n = 1; n < places.size(); ++n) {
      if (!(places[n] > places[n - 1])) continue;
      const double middle = 0.5 * (places[n - 1] + places[n]);
      column.clear();
      for (const auto& [stretch, slab] : met)
        if (stretch.from <= middle && middle <= stretch.to)
          column.push_back({slab->slab.height_m(from + middle * (to - from)), slab});
      std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.z_m < b.z_m; });
      visit(ShareStretch{places[n - 1], places[n]}, column);
    }
  }

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

SolidToGround::Parts SolidToGround::parts_of(const Segment3d& edge) const {
  const double run_m = norm(horizontal(edge.b - edge.a));
  if (slabs_.empty() || run_m <= contact_m) return {};
  Parts parts;
  std::vector<ShareStretch> buried_left, buried_right;
  Beside(edge, 1.0, *this).find(parts.grounded, buried_left);
  Beside(edge, -1.0, *this).find(parts.grounded, buried_right);
  const double give = contact_m / run_m;
  parts.grounded = tidied(std::move(parts.grounded), give);
  // What is buried on both sides
  parts.buried = tidied(std::move(buried_left), 0.0);
  std::vector<ShareStretch> open{{}};
  for (const ShareStretch& s : buried_right) open = without(open, s);
  for (const ShareStretch& s : open) parts.buried = without(parts.buried, s);
  return parts;
}

}  // namespace farlod::tiles
