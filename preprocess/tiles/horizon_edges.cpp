// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/horizon_edges.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "tiles/cutting.hpp"

namespace farlod {
namespace {

/// Minus zero equals zero, but has other bits.
Point3d without_minus_zero(const Point3d& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }

bool comes_first(const Point3d& a, const Point3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// A point of the edge; its ends exactly, and nothing beyond them.
Point3d point_at(const Segment3d& s, double t) {
  return {std::lerp(s.a.x, s.b.x, t), std::lerp(s.a.y, s.b.y, t), std::lerp(s.a.z, s.b.z, t)};
}

/// Where, between 0 and 1, a coordinate that runs from `a` to `b` meets the borders of the grid.
void add_crossings(double a, double b, const Grid& grid, std::vector<double>& places) {
  const std::int32_t last = grid.interval_of(std::max(a, b));
  for (std::int32_t k = grid.interval_of(std::min(a, b)) + 1; k <= last; ++k) places.push_back((grid.border_m(k) - a) / (b - a));
}

}  // namespace

void EdgeSides::add(const Point3d& opposite, FacetLook look) {
  ++triangle_count_;
  const Point3d along = edge_.b - edge_.a, v = opposite - edge_.a;
  const double run_m = norm(horizontal(along)), length_m = norm(along);
  // Rounding decides which way the planes of slivers look: they say nothing
  if (run_m < least_extent_m || norm(cross(along, v)) < least_extent_m * length_m) return;
  const double aside_m = (along.x * v.y - along.y * v.x) / run_m;
  const double ahead_m = dot(horizontal(along), horizontal(v)) / run_m;
  // At right angles to the edge: horizontally, and upwards
  const double rise_m = (v.z * run_m - ahead_m * along.z) / length_m;
  const double rise_rad = std::atan2(rise_m, std::abs(aside_m));
  const bool is_left = aside_m > 0.0;
  // A wall that rises from the edge leaves it to the other facets what is seen below
  if (std::abs(aside_m) <= leaning_wall_z * std::abs(rise_m)) {
    over_wall_ |= rise_m < 0.0;
  } else {
    double& low_rad = is_left ? left_low_rad_ : right_low_rad_;
    low_rad = std::min(low_rad, rise_rad);
    (look == FacetLook::up ? has_roof_ : has_soffit_) = true;
  }
  if (std::abs(aside_m) <= angle_tolerance_rad * std::abs(rise_m)) {
    under_wall_ |= rise_m > 0.0;
    return;
  }
  double& side_rad = is_left ? left_rad_ : right_rad_;
  side_rad = std::max(side_rad, rise_rad);
}

void EdgeSides::add_sides_of(const EdgeSides& other) {
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

bool EdgeSides::can_be_underside() const {
  const Point3d along = edge_.b - edge_.a;
  if (norm(horizontal(along)) <= std::max(least_extent_m, leaning_wall_z * norm(along)) || over_wall_) return false;
  return left_low_rad_ + right_low_rad_ > slight_bend_rad && !is_valley();
}

bool EdgeSides::is_valley() const {
  return triangle_count_ > 1 && has_roof_ && !has_soffit_ && !over_wall_ && left_low_rad_ + right_low_rad_ > slight_bend_rad;
}

bool EdgeSides::can_be_horizon() const {
  if (norm(horizontal(edge_.b - edge_.a)) <= upright_m || under_wall_) return false;
  return left_rad_ + right_rad_ < -angle_tolerance_rad;
}

std::size_t EdgeTable::Hash::operator()(const Segment3d& s) const {
  std::size_t seed = 0;
  for (const double x : {s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z})
    seed ^= std::hash<double>{}(x) + 0x9E3779B97F4A7C15U + (seed << 6) + (seed >> 2);
  return seed;
}

void EdgeTable::add_edge(const Point3d& a, const Point3d& b, const Point3d& opposite, FacetLook look) {
  const Segment3d key = comes_first(a, b) ? Segment3d{a, b} : Segment3d{b, a};
  const auto [entry, is_new] = place_of_.try_emplace(key, edges_.size());
  if (is_new) edges_.emplace_back(key.a, key.b);
  edges_[entry->second].add(opposite, look);
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

CellEdge whole_edge(const HorizonSegment& edge, Cell cell, const Grid& grid, double height_origin_m) {
  return {cell,
          {cell_from_grid(edge.segment.a, cell, grid, height_origin_m),
           cell_from_grid(edge.segment.b, cell, grid, height_origin_m), edge.adjacent, edge.role}};
}

std::vector<CellEdge> cut_edge(const HorizonSegment& horizon, const Grid& grid, double height_origin_m) {
  const Segment3d& edge = horizon.segment;
  const Cell cell = grid.cell_of(horizontal(edge.a));
  if (cell == grid.cell_of(horizontal(edge.b))) return {whole_edge(horizon, cell, grid, height_origin_m)};
  std::vector<double> places{0.0, 1.0};
  add_crossings(edge.a.x, edge.b.x, grid, places);
  add_crossings(edge.a.y, edge.b.y, grid, places);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<CellEdge> pieces;
  for (std::size_t n = 1; n < places.size(); ++n) {
    const Cell owner = grid.cell_of(horizontal(point_at(edge, 0.5 * (places[n - 1] + places[n]))));
    pieces.push_back(whole_edge({{point_at(edge, places[n - 1]), point_at(edge, places[n])}, horizon.adjacent, horizon.role}, owner,
                                grid, height_origin_m));
  }
  return pieces;
}

}  // namespace farlod
