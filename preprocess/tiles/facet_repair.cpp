// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/facet_repair.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "city/geometry.hpp"
#include "tiles/facet_triangulation.hpp"
#include "tiles/ring_sides.hpp"

namespace farlod::tiles {
namespace {

struct Corner {
  Point3d p;
  std::size_t number = 0;
};
/// A corner with a shorter leg may be a real one: rounding turns such a leg by up to a tenth of a radian.
constexpr double least_spike_m = 10.0 * spike_width_m;

/// Length of the spike at `tip` between its neighbors; 0 when there is none.
double length_of_spike_m(const Point3d& before, const Point3d& tip, const Point3d& after) {
  const Point3d there = before - tip, back = after - tip;
  if (dot(there, back) <= 0.0) return 0.0;  // nearly all corners of buildings
  const double longer = std::max(norm(there), norm(back)), shorter = std::min(norm(there), norm(back));
  if (shorter < least_spike_m) return 0.0;
  return norm(cross(there, back)) <= spike_width_m * longer ? shorter : 0.0;
}

class Despiking {
 public:
  explicit Despiking(std::span<const Point3d> ring) {
    for (const Point3d& p : ring) corners_.push_back({p, corners_.size()});
  }

  DespikedRing run() {
    // The removal of a tip may turn a neighbor into the next tip: step back after each removal, and end when a whole round is
    // clean
    std::size_t clean = 0;
    for (auto corner = corners_.begin(); corners_.size() >= 3 && clean < corners_.size();) {
      const double length_m = length_of_spike_m(before(corner)->p, corner->p, after(corner)->p);
      if (length_m == 0.0) {
        corner = after(corner);
        ++clean;
        continue;
      }
      spikes_.push_back({corner->number, corner->p, length_m});
      corner = remove(corner);
      // Both corners beside the removed tip have a new neighbor: test them again
      clean = std::min(clean - std::min<std::size_t>(clean, 1), corners_.size() - 2);
    }
    DespikedRing result{{}, std::move(spikes_)};
    for (const Corner& corner : corners_) result.ring.push_back(corner.p);
    return result;
  }

 private:
  using Place = std::list<Corner>::iterator;

  Place before(Place corner) { return std::prev(corner == corners_.begin() ? corners_.end() : corner); }
  Place after(Place corner) { return std::next(corner) == corners_.end() ? corners_.begin() : std::next(corner); }

  /// Removes a tip, and the corner after it when that equals the corner before the tip. Returns the corner before.
  Place remove(Place tip) {
    const Place left = before(tip), right = after(tip);
    const bool is_shut = norm(left->p - right->p) <= spike_width_m;
    corners_.erase(tip);
    if (is_shut) corners_.erase(right);
    return left;
  }

  std::list<Corner> corners_;  // of which any may go at any time
  std::vector<Spike> spikes_;
};

bool has_spike(std::span<const Point3d> ring) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k)
    if (length_of_spike_m(ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]) > 0.0) return true;
  return false;
}

}  // namespace

std::optional<DespikedRing> without_spikes(std::span<const Point3d> ring) {
  // A triangle is never changed: nothing would remain of the slivers of a mesh
  if (ring.size() <= 3 || !has_spike(ring)) return std::nullopt;
  DespikedRing despiked = Despiking(ring).run();
  if (despiked.ring.size() < 3) return std::nullopt;
  return despiked;
}

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

namespace {

void remove_spikes(RepairedFacet& facet) {
  for (std::size_t k = 0; k < facet.rings.size(); ++k) {
    auto despiked = without_spikes(facet.rings[k]);
    if (!despiked) continue;
    for (const Spike& spike : despiked->spikes)
      facet.findings.push_back({ProblemCode::spike, k,
                                "vertex " + std::to_string(spike.vertex) + " of ring " + std::to_string(k) + " lies " +
                                    metres(spike.length_m) + " out on a way that is run there and back",
                                spike.tip});
    facet.rings[k] = facet.changed.emplace_back(std::move(despiked->ring));
  }
}

void sort_holes(RepairedFacet& facet) {
  const RingPlaces places = places_of_rings(facet.rings);
  for (const MisplacedHole& hole : places.misplaced)
    facet.findings.push_back(
        {ProblemCode::hole_outside, hole.ring, std::string(hole.reason) + ", and was left out", facet.rings[hole.ring].front()});
  if (places.true_outer)
    facet.findings.push_back({ProblemCode::self_intersecting, *places.true_outer,
                              "a hole surrounds the outer ring: the two were exchanged",
                              facet.rings[*places.true_outer].front()});
  std::vector<bool> is_misplaced(facet.rings.size(), false);
  for (const MisplacedHole& hole : places.misplaced) is_misplaced[hole.ring] = true;
  std::vector<std::span<const Point3d>> kept;
  for (std::size_t k = 0; k < facet.rings.size(); ++k)
    if (!is_misplaced[k]) kept.insert(k == places.true_outer ? kept.begin() : kept.end(), facet.rings[k]);
  facet.rings = std::move(kept);
}

}  // namespace

RepairedFacet repaired_rings(const CityModel& city, const Facet& facet) {
  RepairedFacet repaired;
  for (std::uint32_t k = 0; k < facet.ring_count; ++k) repaired.rings.push_back(city.ring(facet, k));
  remove_spikes(repaired);
  if (repaired.rings.size() > 1) sort_holes(repaired);
  return repaired;
}

std::string name_of_ring(std::size_t ring) { return ", ring " + std::to_string(ring) + (ring == 0 ? " (outer)" : " (hole)"); }

}  // namespace farlod::tiles
