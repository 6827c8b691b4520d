// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/misplaced_holes.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "city/cyclic_order.hpp"
#include "city/plan_boxes.hpp"
#include "tiles/box_tree.hpp"
#include "tiles/facet_projection.hpp"
#include "tiles/facet_triangulation.hpp"
#include "tiles/ring_sides.hpp"

namespace farlod::tiles {
namespace {

/// Rings that really hide each other are looked at a few times each. Only rings that are all tangled up need more than this
/// for each of their corners.
constexpr std::size_t usual_work = 20'000'000, work_for_each_corner = 256;

RingSides flat(std::span<const Point3d> ring, const FacetProjection& project) {
  std::vector<Point2d> outline;
  outline.reserve(ring.size());
  for (const Point3d& p : ring) outline.push_back(project(p));
  return RingSides(std::move(outline));
}

class Placing {
 public:
  explicit Placing(std::vector<RingSides> rings) : rings_(std::move(rings)), is_misplaced_(rings_.size(), false) {
    for (const RingSides& ring : rings_) most_work_ += work_for_each_corner * ring.points().size();
  }

  RingPlaces run() {
    for (std::size_t k = 1; k < rings_.size() && !result_.true_outer && !is_too_tangled(); ++k)
      if (lies_in(0, k) && !are_same(0, k)) result_.true_outer = k;
    const std::size_t outer = result_.true_outer.value_or(0);
    for (std::size_t k = 0; k < rings_.size(); ++k)
      if (k != outer) compare_with_outer(outer, k);
    compare_holes(outer);
    std::sort(result_.misplaced.begin(), result_.misplaced.end(),
              [](const MisplacedHole& a, const MisplacedHole& b) { return a.ring < b.ring; });
    return std::move(result_);
  }

 private:
  void note(std::size_t k, std::string_view reason) {
    is_misplaced_[k] = true;
    result_.misplaced.push_back({k, reason});
  }

  void compare_with_outer(std::size_t outer, std::size_t k) {
    RingSides &whole = rings_[outer], &hole = rings_[k];
    if (!boxes_meet(whole.box(), hole.box())) return note(k, "it lies outside of the outer ring");
    if (are_same(outer, k)) return note(k, "it is the outer ring once more");
    if (is_too_tangled()) return note(k, too_tangled);
    const std::size_t before = whole.work() + hole.work();
    // Test the first corner before the crossing of rings: it nearly always lies inside
    if (whole.side_of(hole) == RingSide::outside && !whole.crosses(hole)) note(k, "it lies outside of the outer ring");
    work_ += whole.work() + hole.work() - before;
  }

  /// Compares each hole with those whose boxes meet its own, in the order of the file.
  void compare_holes(std::size_t outer) {
    std::vector<Box2d> boxes;
    for (const RingSides& ring : rings_) boxes.push_back(ring.box());
    const BoxTree tree(boxes);
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < rings_.size(); ++k) {
      if (k == outer || is_misplaced_[k]) continue;
      if (is_too_tangled()) {
        note(k, too_tangled);
        continue;
      }
      near.clear();
      tree.for_each_meeting(boxes[k], [&](std::size_t j) {
        if (j != k && j != outer && !is_misplaced_[j]) near.push_back(j);
      });
      work_ += near.size();
      std::sort(near.begin(), near.end());
      for (const std::size_t j : near)
        if (!is_misplaced_[k] && !is_misplaced_[j]) compare_with_hole(j, k);
    }
  }

  void compare_with_hole(std::size_t j, std::size_t k) {
    if (are_same(j, k))
      note(std::max(j, k), "it is another hole once more");
    else if (lies_in(k, j))
      note(k, "it lies within another hole");
  }

  [[nodiscard]] bool lies_in(std::size_t inner, std::size_t outer) {
    const Box2d &i = rings_[inner].box(), &o = rings_[outer].box();
    if (!o.contains(i.low) || !o.contains(i.high)) return false;
    RingSides &there = rings_[outer], &here = rings_[inner];
    const std::size_t before = there.work() + here.work();
    const bool is_within = there.side_of(here) == RingSide::inside && !there.crosses(here);
    work_ += there.work() + here.work() - before;
    return is_within;
  }

  [[nodiscard]] bool are_same(std::size_t j, std::size_t k) {
    const RingSides &a = rings_[j], &b = rings_[k];
    if (a.points().size() != b.points().size() || a.box() != b.box()) return false;
    work_ += a.points().size();
    const std::vector<Point2d> reversed(b.points().rbegin(), b.points().rend());
    return is_rotation_of(a.points(), b.points()) || is_rotation_of(a.points(), reversed);
  }

  [[nodiscard]] bool is_too_tangled() const { return work_ > most_work_; }

  static constexpr std::string_view too_tangled =
      "the facet has so many rings across each other that it was not compared with all";

  std::vector<RingSides> rings_;
  std::vector<bool> is_misplaced_;
  std::size_t work_ = 0, most_work_ = usual_work;
  RingPlaces result_;
};

}  // namespace

RingPlaces places_of_rings(std::span<const std::span<const Point3d>> rings) {
  if (rings.size() < 2) return {};
  const Point3d normal = area_vector(rings.first(1));
  if (norm(normal) == 0.0) return {};
  const FacetProjection project = FacetProjection::dropping_a_coordinate(normal);
  std::vector<RingSides> flat_rings;
  flat_rings.reserve(rings.size());
  for (const auto ring : rings) flat_rings.push_back(flat(ring, project));
  return Placing(std::move(flat_rings)).run();
}

}  // namespace farlod::tiles
