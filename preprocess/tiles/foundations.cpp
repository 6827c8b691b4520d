// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/foundations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "base/ground_contact.hpp"
#include "city/geometry.hpp"
#include "tiles/building_bases.hpp"

namespace farlod::tiles {

namespace {

/// Depth of a foundation below the ground, which may bend between the places that are sampled.
constexpr double below_ground_m = 0.5;

/// Calls `visit` for each place of a border at which it is compared with the ground.
template <class Visit>
void visit_places(const HorizonSegment& border, const Visit& visit) {
  const auto& [a, b] = border.segment;
  const int intervals = ground_sampling_intervals(norm(horizontal(b - a)));
  for (int k = 0; k <= intervals; ++k) visit(a + static_cast<double>(k) / intervals * (b - a));
}

/// The largest height of the borders above the ground.
double largest_gap_m(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height) {
  double largest_m = 0.0;
  for (const HorizonSegment& border : foot)
    visit_places(border, [&](const Point3d& p) { largest_m = std::max(largest_m, p.z - ground_height(horizontal(p))); });
  return largest_m;
}

}  // namespace

std::optional<Foundation> take_foundation(std::span<const Point3d> building_points, Foot foot,
                                          std::vector<HorizonSegment>& undersides, const GroundHeightAt& ground_height) {
  double lowest_m = std::numeric_limits<double>::infinity(), least_gap_m = lowest_m;
  double highest_m = -lowest_m;
  for (const Point3d& p : building_points) {
    lowest_m = std::min(lowest_m, p.z);
    highest_m = std::max(highest_m, p.z);
  }
  Foundation foundation{lowest_m + lowest_floor_thickness_m, 0.0, {}, {}};
  // (1) A person can walk below the floor from all sides
  for (const Point3d& p : building_points)
    if (p.z <= foundation.top_m) least_gap_m = std::min(least_gap_m, p.z - ground_height(horizontal(p)));
  const bool must_reach_down = foot == Foot::on_ground;
  if (least_gap_m > least_clearance_m && !must_reach_down) return std::nullopt;
  // (2) Separate the borders of the lowest floor from the other lower borders
  const auto is_foot = [&](const HorizonSegment& s) { return std::max(s.segment.a.z, s.segment.b.z) <= foundation.top_m; };
  const auto feet = std::stable_partition(undersides.begin(), undersides.end(), std::not_fn(is_foot));
  if (feet == undersides.end()) return std::nullopt;
  // (3) The building is thinner than the gap below it
  foundation.gap_m = largest_gap_m({feet, undersides.end()}, ground_height);
  if (foundation.gap_m > highest_m - lowest_m && !must_reach_down) return std::nullopt;
  foundation.place = feet->segment.a;
  foundation.walls = foundation_walls({feet, undersides.end()}, ground_height);
  undersides.erase(feet, undersides.end());
  return foundation;
}

std::vector<std::array<Point3d, 3>> foundation_walls(std::span<const HorizonSegment> foot, const GroundHeightAt& ground_height) {
  std::vector<std::array<Point3d, 3>> walls;
  for (const HorizonSegment& border : foot) {
    const auto& [a, b] = border.segment;
    double lowest_m = std::min(a.z, b.z);
    visit_places(border, [&](const Point3d& p) { lowest_m = std::min(lowest_m, ground_height(horizontal(p))); });
    const Point3d below_a{a.x, a.y, lowest_m - below_ground_m}, below_b{b.x, b.y, lowest_m - below_ground_m};
    walls.push_back({a, below_a, below_b});
    walls.push_back({a, below_b, b});
  }
  return walls;
}

namespace {

/// The heights of borders above the ground.
struct GapsOfBorders {
  double least_m = std::numeric_limits<double>::infinity(), largest_m = 0.0;
  double open_m2 = 0.0, length_m = 0.0;  ///< below the borders, and along them

  void add(const GapsOfBorders& other) {
    least_m = std::min(least_m, other.least_m);
    largest_m = std::max(largest_m, other.largest_m);
    open_m2 += other.open_m2;
    length_m += other.length_m;
  }
};

GapsOfBorders gaps_below(const HorizonSegment& border, const GroundHeightAt& ground_height) {
  GapsOfBorders gaps;
  int places = 0;
  double sum_m = 0.0;
  visit_places(border, [&](const Point3d& p) {
    const double gap_m = std::max(p.z - ground_height(horizontal(p)), 0.0);
    gaps.least_m = std::min(gaps.least_m, gap_m);
    gaps.largest_m = std::max(gaps.largest_m, gap_m);
    sum_m += gap_m;
    ++places;
  });
  gaps.length_m = norm(horizontal(border.segment.b - border.segment.a));
  gaps.open_m2 = gaps.length_m * sum_m / places;
  return gaps;
}

/// An edge of a slab that looks down; its end `a` comes first.
struct SlabEdge {
  Segment3d edge;
  std::size_t slab = 0;
  bool is_outline = true;  ///< no other slab of the floor shares it
  friend bool operator<(const SlabEdge& l, const SlabEdge& r) {
    return comes_first(l.edge.a, r.edge.a) || (l.edge.a == r.edge.a && comes_first(l.edge.b, r.edge.b));
  }
};

bool lies_along(const Segment3d& border, const Segment3d& edge) {
  const Point3d along = edge.b - edge.a;
  const double square = dot(along, along), give = on_line_m * std::sqrt(square);
  const auto is_on = [&](const Point3d& p) {
    const double share = dot(p - edge.a, along);
    return share >= -give && share <= square + give && norm(cross(along, p - edge.a)) <= give;
  };
  return square > 0.0 && is_on(border.a) && is_on(border.b);
}

bool lies_in_plan(const Slab& slab, Point2d p) {
  const Point2d a = horizontal(slab.corners[0]), b = horizontal(slab.corners[1]), c = horizontal(slab.corners[2]);
  const double turn = std::copysign(1.0, across(b - a, c - a));
  return turn * across(b - a, p - a) >= 0.0 && turn * across(c - b, p - b) >= 0.0 && turn * across(a - c, p - c) >= 0.0;
}

struct FloorOfSlabs {
  std::vector<std::size_t> slabs, undersides;
  double outline_m = 0.0;  ///< length in plan
  GapsOfBorders gaps;      ///< of its undersides
};

/// The floors of a building, and the borders of each.
class FloorsOfBuilding {
 public:
  explicit FloorsOfBuilding(std::span<const Slab> slabs) : first_of_(slabs.size()), floors_(slabs.size()) {
    std::iota(first_of_.begin(), first_of_.end(), std::size_t{0});
    for (std::size_t n = 0; n < slabs.size(); ++n)
      if (slabs[n].look == FacetLook::down) add_edges(slabs[n], n);
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t n = 1; n < edges_.size(); ++n)
      if (edges_[n].edge == edges_[n - 1].edge) join(edges_[n - 1], edges_[n]);
    for (const SlabEdge& e : edges_)
      if (e.is_outline) floors_[floor_of(e.slab)].outline_m += norm(horizontal(e.edge.b - e.edge.a));
    for (std::size_t n = 0; n < slabs.size(); ++n)
      if (slabs[n].look == FacetLook::down) floors_[floor_of(n)].slabs.push_back(n);
  }

  void add_underside(std::size_t number, const Segment3d& border, const GapsOfBorders& gaps) {
    const auto [west_m, east_m] = std::minmax(border.a.x, border.b.x);
    const auto is_west = [](const SlabEdge& e, double x_m) { return e.edge.a.x < x_m; };
    auto e = std::lower_bound(edges_.begin(), edges_.end(), east_m - on_line_m - widest_m_, is_west);
    for (; e != edges_.end() && e->edge.a.x <= west_m + on_line_m; ++e) {
      if (!lies_along(border, e->edge)) continue;
      FloorOfSlabs& floor = floors_[floor_of(e->slab)];
      floor.undersides.push_back(number);
      floor.gaps.add(gaps);
      return;
    }
  }

  [[nodiscard]] const std::vector<FloorOfSlabs>& floors() const { return floors_; }

 private:
  void add_edges(const Slab& slab, std::size_t number) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3d &a = slab.corners.at(k), &b = slab.corners.at((k + 1) % 3);
      edges_.push_back({comes_first(b, a) ? Segment3d{b, a} : Segment3d{a, b}, number});
      widest_m_ = std::max(widest_m_, std::abs(b.x - a.x));
    }
  }
  void join(SlabEdge& one, SlabEdge& other) {
    one.is_outline = other.is_outline = false;
    first_of_[floor_of(one.slab)] = floor_of(other.slab);
  }
  [[nodiscard]] std::size_t floor_of(std::size_t slab) {
    while (first_of_[slab] != slab) slab = first_of_[slab] = first_of_[first_of_[slab]];
    return slab;
  }

  std::vector<std::size_t> first_of_;  ///< of each slab, a slab of the same floor: itself at the end
  std::vector<SlabEdge> edges_;        ///< from west to east
  double widest_m_ = 0.0;
  std::vector<FloorOfSlabs> floors_;  ///< by their last slab
};

/// The vertical through the middle of a slab that looks down.
struct ColumnOfFloor {
  double above_m = 0.0, below_m = 0.0;  ///< of the building, up to the next roof, and of the air
  bool is_air = true;                   ///< nothing but air is between the slab and the ground
};

ColumnOfFloor column_of(std::size_t floor, std::span<const Slab> slabs, const GroundHeightAt& ground_height) {
  const auto& [a, b, c] = slabs[floor].corners;
  const Point3d middle = (1.0 / 3.0) * (a + b + c);
  const Point2d place = horizontal(middle);
  const double ground_m = ground_height(place);
  double roof_m = std::numeric_limits<double>::infinity();
  int solids = -1;  // around the place right below the slab: each has a roof above, and none of them its floor
  ColumnOfFloor column;
  for (std::size_t n = 0; n < slabs.size(); ++n) {
    if (n == floor || !lies_in_plan(slabs[n], place)) continue;
    const bool looks_up = slabs[n].look == FacetLook::up;
    const double height_m = slabs[n].height_m(place);
    if (height_m >= middle.z) solids += looks_up ? 1 : -1;
    if (height_m >= middle.z && looks_up) roof_m = std::min(roof_m, height_m);
    if (height_m < middle.z && looks_up && height_m > ground_m + ground_contact_m) column.is_air = false;
  }
  column.is_air = column.is_air && solids <= 0;
  column.above_m = std::isfinite(roof_m) ? roof_m - middle.z : 0.0;
  column.below_m = std::max(middle.z - ground_m, 0.0);
  return column;
}

/// Promises (2) to (4) of take_low_floors.
bool is_hollow_below(const FloorOfSlabs& floor, std::span<const Slab> slabs, const GroundHeightAt& ground_height) {
  double area_m2 = 0.0, above_m3 = 0.0, below_m3 = 0.0;
  for (const std::size_t n : floor.slabs) {
    const ColumnOfFloor column = column_of(n, slabs, ground_height);
    if (!column.is_air) return false;
    const auto& [a, b, c] = slabs[n].corners;
    const double plan_m2 = 0.5 * std::abs(across(horizontal(b - a), horizontal(c - a)));
    area_m2 += plan_m2;
    above_m3 += plan_m2 * column.above_m;
    below_m3 += plan_m2 * column.below_m;
  }
  return above_m3 > below_m3 && 2.0 * area_m2 > floor.outline_m * floor.gaps.largest_m;
}

/// Closes the floor if promise (1) holds: adds its borders to `closed`.
LowFloor low_floor(const FloorOfSlabs& floor, std::span<Slab> slabs, std::span<const HorizonSegment> undersides,
                   const GroundHeightAt& ground_height, std::vector<HorizonSegment>& closed) {
  LowFloor low{floor.gaps.least_m, floor.gaps.largest_m, undersides[floor.undersides.front()].segment.a, {}, {}};
  const double open_to_clearance_m2 = least_clearance_m * floor.gaps.length_m;
  if (low.largest_gap_m > storey_m || floor.gaps.open_m2 >= open_to_clearance_m2) return low;
  const std::size_t first = closed.size();
  for (const std::size_t n : floor.undersides) closed.push_back(undersides[n]);
  low.walls = foundation_walls(std::span(closed).subspan(first), ground_height);
  for (const std::size_t n : floor.slabs) {
    slabs[n].on_ground = true;
    low.lid.push_back(slabs[n].corners);
  }
  return low;
}

}  // namespace

std::vector<LowFloor> take_low_floors(std::span<Slab> slabs, std::vector<HorizonSegment>& undersides,
                                      const GroundHeightAt& ground_height) {
  // (1) Most of what overhangs is higher
  std::vector<GapsOfBorders> gaps;
  for (const HorizonSegment& border : undersides) gaps.push_back(gaps_below(border, ground_height));
  const auto is_low = [](const GapsOfBorders& g) { return g.least_m < least_clearance_m; };
  if (slabs.empty() || std::none_of(gaps.begin(), gaps.end(), is_low)) return {};
  // (2) Find the floors, and the borders of each
  FloorsOfBuilding building(slabs);
  for (std::size_t n = 0; n < undersides.size(); ++n) building.add_underside(n, undersides[n].segment, gaps[n]);
  // (3) Close those that are hollow below
  std::vector<LowFloor> result;
  std::vector<HorizonSegment> closed;
  for (const FloorOfSlabs& floor : building.floors())
    if (is_low(floor.gaps) && is_hollow_below(floor, slabs, ground_height))
      result.push_back(low_floor(floor, slabs, undersides, ground_height, closed));
  std::erase_if(undersides, [&](const HorizonSegment& s) { return std::find(closed.begin(), closed.end(), s) != closed.end(); });
  return result;
}

void add_wall_profiles(const LowFloor& floor, std::vector<WallProfile>& walls) {
  // Two triangles are a wall
  for (std::size_t n = 1; n < floor.walls.size(); n += 2) {
    const auto& [a, below_a, below_b] = floor.walls[n - 1];
    if (auto profile = wall_profile(std::array{a, below_a, below_b, floor.walls[n][2]})) walls.push_back(std::move(*profile));
  }
}

Problem floor_in_the_air(const Building& building, const Foundation& foundation) {
  return {ProblemCode::floor_in_the_air,
          {},
          building.id,
          "the lowest floor is up to " + metres(foundation.gap_m) + " above the ground: closed down to it",
          foundation.place};
}

Problem floor_in_the_air(const Building& building, const LowFloor& floor) {
  return {ProblemCode::floor_in_the_air,
          {},
          building.id,
          "a floor that is not the lowest is " + metres(floor.least_gap_m) + " to " + metres(floor.largest_gap_m) +
              " above the ground: left open, where the ground may see hardly any sky",
          floor.place};
}

std::optional<Problem> below_ground(const Building& building, std::span<const Point3d> building_points,
                                    const GroundHeightAt& ground_height) {
  if (building_points.empty()) return std::nullopt;
  const auto lowest = std::ranges::min_element(building_points, {}, &Point3d::z),
             top = std::ranges::max_element(building_points, {}, &Point3d::z);
  const double middle_m = 0.5 * (lowest->z + top->z);
  double least_ground_m = std::numeric_limits<double>::infinity();
  bool is_all_below = true;
  for (const Point3d& p : building_points) {
    const double ground_m = ground_height(horizontal(p)) - ground_contact_m;
    // The middle of nearly all buildings is above the ground at the first corner
    if (ground_m <= middle_m) return std::nullopt;
    least_ground_m = std::min(least_ground_m, ground_m + ground_contact_m);
    is_all_below = is_all_below && p.z < ground_m;
  }
  const std::string detail = is_all_below ? "its highest point is " + metres(ground_height(horizontal(*top)) - top->z) +
                                                " below the ground: its surfaces see no sky, and hide none"
                                          : metres(least_ground_m - lowest->z) + " of its " + metres(top->z - lowest->z) +
                                                " are below the ground at each of its corners";
  return Problem{ProblemCode::below_ground, {}, building.id, detail, *top};
}

}  // namespace farlod::tiles
