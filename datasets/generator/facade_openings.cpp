// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/facade_openings.hpp"

#include <algorithm>

#include "generator/solid_builder.hpp"

namespace farlod {
namespace {

constexpr double bay_m = 3.2, window_width_m = 1.2, sill_m = 0.9, head_m = 2.3;
constexpr double door_width_m = 1.0, door_sill_m = 0.15, door_head_m = 2.25;
constexpr double set_back_m = 0.12, set_back_share = 0.5;
/// The least height of a row of windows. Lower storeys share one row.
constexpr double least_row_m = 2.6;
/// The least distance between an opening and the border of its wall.
constexpr double least_margin_m = 0.12;

/// The vertical rectangle above the lower edge of a wall, without its gable.
struct WallRectangle {
  Point2d a, b;
  double low_m, high_m;

  [[nodiscard]] double width_m() const { return norm(b - a); }
  [[nodiscard]] Point2d along() const { return (1.0 / width_m()) * (b - a); }
  /// Unit vector into the building: it lies to the left of a → b.
  [[nodiscard]] Point2d inwards() const { return {-along().y, along().x}; }
};

[[nodiscard]] bool has_rectangle(const PlanFacet& facet) {
  const PlanRing& r = facet.outer;
  return facet.role == FacetRole::wall && facet.filling == Filling::none && (r.size() == 4 || r.size() == 5) &&
         r[0].z == r[1].z && horizontal(r[1]) == horizontal(r[2]) && horizontal(r[0]) == horizontal(r.back());
}

struct Opening {
  Filling filling;
  double middle_m, width_m, low_m, high_m;  ///< distance along the wall from its left end; heights above the ground
};

/// The corners of an opening, counter-clockwise seen from outside, in the plane `behind_m` behind the wall.
[[nodiscard]] PlanRing ring_of(const WallRectangle& wall, const Opening& o, double behind_m) {
  const Point2d inwards = behind_m * wall.inwards();
  const Point2d left = wall.a + (o.middle_m - 0.5 * o.width_m) * wall.along() + inwards;
  const Point2d right = wall.a + (o.middle_m + 0.5 * o.width_m) * wall.along() + inwards;
  return {{left.x, left.y, o.low_m}, {right.x, right.y, o.low_m}, {right.x, right.y, o.high_m}, {left.x, left.y, o.high_m}};
}

class OpeningCutter {
 public:
  OpeningCutter(PlanSolid& solid, double row_m, double behind_m) : solid_(solid), row_m_(row_m), behind_m_(behind_m) {}

  void cut(std::size_t wall_row) {
    const PlanRing& r = solid_.facets[wall_row].outer;
    const WallRectangle wall{horizontal(r[0]), horizontal(r[1]), r[0].z, r[2].z};
    const int bays = static_cast<int>(wall.width_m() / bay_m);
    const bool has_door = !door_is_there_ && wall.low_m == 0.0 && bays > 0;
    for (int row = 0; row * row_m_ < wall.high_m; ++row)
      for (int bay = 0; bay < bays; ++bay)
        add(wall_row, wall, opening(has_door && row == 0 && bay == bays / 2, row, (bay + 0.5) * wall.width_m() / bays));
    door_is_there_ |= has_door;
  }

 private:
  [[nodiscard]] Opening opening(bool is_door, int row, double middle_m) const {
    const double floor_m = row * row_m_;
    if (is_door) return {Filling::door, middle_m, door_width_m, door_sill_m, door_head_m};
    return {Filling::window, middle_m, window_width_m, on_plan_grid_m(floor_m + sill_m), on_plan_grid_m(floor_m + head_m)};
  }

  void add(std::size_t wall_row, const WallRectangle& wall, const Opening& o) {
    if (o.low_m < wall.low_m + least_margin_m || o.high_m > wall.high_m - least_margin_m) return;
    const PlanRing in_wall = ring_of(wall, o, 0.0), filling = ring_of(wall, o, behind_m_);
    solid_.facets[wall_row].openings.push_back(reversed_ring(in_wall));
    solid_.facets.push_back({.outer = filling, .filling = o.filling, .in_wall = wall_row});
    if (behind_m_ == 0.0) return;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      solid_.facets.push_back({.outer = {in_wall[k], in_wall[next], filling[next], filling[k]}});
    }
  }

  PlanSolid& solid_;
  double row_m_, behind_m_;
  bool door_is_there_ = false;
};

}  // namespace

void add_openings(KeyedRandom& random, const BuildingPlan& plan, const TouchingWalls& walls, std::size_t row, PlanSolid& solid) {
  const bool set_back = random.chance(set_back_share);
  OpeningCutter cutter(solid, std::max(least_row_m, plan.wall_m / plan.storeys), set_back ? set_back_m : 0.0);
  const std::size_t facets = solid.facets.size();
  for (std::size_t k = 0; k < facets; ++k) {
    const PlanRing& r = solid.facets[k].outer;
    if (has_rectangle(solid.facets[k]) && !walls.touches(row, horizontal(r[0]), horizontal(r[1]))) cutter.cut(k);
  }
}

}  // namespace farlod
