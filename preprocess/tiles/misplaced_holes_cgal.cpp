// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>

#include "city/plan_boxes.hpp"
#include "farlod/box.hpp"
#include "tiles/facet_projection.hpp"
#include "tiles/facet_triangulation.hpp"
#include "tiles/misplaced_holes.hpp"

namespace farlod::tiles {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Outline = std::vector<Point>;

struct FlatRing {
  Outline outline;
  Box2d box;
};

FlatRing flat(std::span<const Point3d> ring, const FacetProjection& project) {
  FlatRing result;
  for (const Point3d& p : ring) {
    const Point2d q = project(p);
    result.outline.emplace_back(q.x, q.y);
    result.box.add(q);
  }
  return result;
}

bool are_same(const Outline& a, Outline b) {
  if (a.size() != b.size()) return false;
  for (int way = 0; way < 2; ++way) {
    for (std::size_t turn = 0; turn < b.size(); ++turn) {
      if (a == b) return true;
      std::rotate(b.begin(), b.begin() + 1, b.end());
    }
    std::reverse(b.begin(), b.end());
  }
  return false;
}

/// On which side of a ring a place lies.
CGAL::Bounded_side side_of(const Point& p, const Outline& ring) {
  return CGAL::bounded_side_2(ring.begin(), ring.end(), p, Kernel());
}

/// On which side of a ring another ring lies that does not cross it: the side of its first corner that is not on the ring, else
/// of the first midpoint of an edge that is not.
CGAL::Bounded_side side_of(const Outline& other, const Outline& ring) {
  for (const Point& p : other)
    if (const auto side = side_of(p, ring); side != CGAL::ON_BOUNDARY) return side;
  for (std::size_t k = 0; k < other.size(); ++k)
    if (const auto side = side_of(CGAL::midpoint(other[k], other[(k + 1) % other.size()]), ring); side != CGAL::ON_BOUNDARY)
      return side;
  return CGAL::ON_BOUNDARY;
}

/// Whether two edges cross properly: the ends of each lie on different sides of the other.
bool edges_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return CGAL::orientation(a, b, c) * CGAL::orientation(a, b, d) < 0 &&
         CGAL::orientation(c, d, a) * CGAL::orientation(c, d, b) < 0;
}

bool has_corner_on(const Outline& other, const Outline& ring, CGAL::Bounded_side side) {
  return std::any_of(other.begin(), other.end(), [&](const Point& p) { return side_of(p, ring) == side; });
}

bool rings_cross(const Outline& a, const Outline& b) {
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
    if (has_corner_on(*one, *other, CGAL::ON_BOUNDED_SIDE) && has_corner_on(*one, *other, CGAL::ON_UNBOUNDED_SIDE)) return true;
  for (std::size_t j = 0; j < a.size(); ++j)
    for (std::size_t k = 0; k < b.size(); ++k)
      if (edges_cross(a[j], a[(j + 1) % a.size()], b[k], b[(k + 1) % b.size()])) return true;
  return false;
}

class Placing {
 public:
  explicit Placing(std::vector<FlatRing> rings) : rings_(std::move(rings)), is_misplaced_(rings_.size(), false) {}

  RingPlaces run() {
    for (std::size_t k = 1; k < rings_.size() && !result_.true_outer; ++k)
      if (!are_same(ring(0), ring(k)) && lies_in(0, k)) result_.true_outer = k;
    const std::size_t outer = result_.true_outer.value_or(0);
    for (std::size_t k = 0; k < rings_.size(); ++k)
      if (k != outer) compare_with_outer(outer, k);
    for (std::size_t k = 0; k < rings_.size(); ++k)
      for (std::size_t j = 0; j < rings_.size() && !is_misplaced_[k]; ++j)
        if (j != k && j != outer && k != outer && !is_misplaced_[j]) compare_with_hole(j, k);
    std::sort(result_.misplaced.begin(), result_.misplaced.end(),
              [](const MisplacedHole& a, const MisplacedHole& b) { return a.ring < b.ring; });
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Outline& ring(std::size_t k) const { return rings_[k].outline; }

  void note(std::size_t k, std::string_view reason) {
    is_misplaced_[k] = true;
    result_.misplaced.push_back({k, reason});
  }

  void compare_with_outer(std::size_t outer, std::size_t k) {
    if (!boxes_meet(rings_[outer].box, rings_[k].box)) return note(k, "it lies outside of the outer ring");
    if (are_same(ring(outer), ring(k))) return note(k, "it is the outer ring once more");
    // Test the first corner before the crossing of rings: it nearly always lies inside
    if (side_of(ring(k), ring(outer)) == CGAL::ON_UNBOUNDED_SIDE && !rings_cross(ring(outer), ring(k)))
      note(k, "it lies outside of the outer ring");
  }

  void compare_with_hole(std::size_t j, std::size_t k) {
    if (!boxes_meet(rings_[j].box, rings_[k].box)) return;
    if (are_same(ring(j), ring(k)))
      note(std::max(j, k), "it is another hole once more");
    else if (lies_in(k, j))
      note(k, "it lies within another hole");
  }

  [[nodiscard]] bool lies_in(std::size_t inner, std::size_t outer) const {
    const Box2d &i = rings_[inner].box, &o = rings_[outer].box;
    if (!o.contains(i.low) || !o.contains(i.high)) return false;
    return side_of(ring(inner), ring(outer)) == CGAL::ON_BOUNDED_SIDE && !rings_cross(ring(inner), ring(outer));
  }

  std::vector<FlatRing> rings_;
  std::vector<bool> is_misplaced_;
  RingPlaces result_;
};

}  // namespace

RingPlaces places_of_rings(std::span<const std::span<const Point3d>> rings) {
  if (rings.size() < 2) return {};
  const Point3d normal = area_vector(rings.first(1));
  if (norm(normal) == 0.0) return {};
  const FacetProjection project = FacetProjection::dropping_a_coordinate(normal);
  std::vector<FlatRing> flat_rings;
  for (const auto ring : rings) flat_rings.push_back(flat(ring, project));
  return Placing(std::move(flat_rings)).run();
}

}  // namespace farlod::tiles
