// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/overhangs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "receivers/point_receivers.hpp"
#include "scene/near_cells.hpp"
#include "scene/vertical_profile.hpp"

namespace farlod {
namespace {

/// An overhang less than this above a receiver is not overhead, as for rays (least_distance_m).
constexpr float min_clearance_m = least_distance_m;

struct Box {
  Point3f low, high;
};

Box box_of(const OverhangGeometry::TriangleCorners& t) {
  Box box{t[0], t[0]};
  for (const Point3f& p : t) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

/// Distance to the left of the line from a to b, times the line's length.
float left_of(const Point3f& a, const Point3f& b, float x, float y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

/// Whether a triangle is above a place: the place lies in it in the plan, and its plane is higher there,
/// z(x, y) = t0_z − (n_x (x − t0_x) + n_y (y − t0_y)) / n_z.
bool is_above(const OverhangGeometry::TriangleCorners& t, float x, float y, float z) {
  int left = 0, right = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3f &a = t[n], &b = t[(n + 1) % 3];
    const float side = left_of(a, b, x, y);
    left += side >= 0.0F ? 1 : 0;
    right += side <= 0.0F ? 1 : 0;
  }
  if (left != 3 && right != 3) return false;
  const Point3f n = cross(t[1] - t[0], t[2] - t[0]);
  return t[0].z - (n.x * (x - t[0].x) + n.y * (y - t[0].y)) / n.z > z + min_clearance_m;
}

/// Upright triangles are above nothing.
bool is_upright(const OverhangGeometry::TriangleCorners& t) {
  const Point3f n = cross(t[1] - t[0], t[2] - t[0]);
  return std::abs(n.z) <= 1e-3F * norm(n);
}

/// Whether a triangle is above no receiver of a cell with this edge.
bool is_beyond_receivers(const OverhangGeometry::TriangleCorners& t, float edge_m) {
  constexpr float off_m = 2.0F * surface_offset_m;
  const auto [low, high] = box_of(t);
  return low.x > edge_m + off_m || low.y > edge_m + off_m || high.x < -off_m || high.y < -off_m;
}

}  // namespace

OverhangGeometry::OverhangGeometry(const PackageReader& package, Cell cell, const WholeCityOnDemand* city)
    : package_(package), cell_(cell), city_(city) {
  // A surface of pixels has one height at each place
  if (package.manifest().heights()) return;
  // Buildings that are cut at the borders of cells are above their own cell alone. Receivers stand off a wall on the border of
  // the cell, and so in the next one
  constexpr std::int32_t reach = TrianglesOfCell::reach_of_whole_buildings;
  const CellRange around{cell.i - 1, cell.j - 1, cell.i + 2, cell.j + 2}, near = package.grid().neighborhood_of(cell);
  const bool is_cut = package.manifest().assign != "whole";
  overhead_ =
      overhanging_in(is_cut ? around
                            : CellRange{std::min(near.i_begin, cell.i - reach), std::min(near.j_begin, cell.j - reach),
                                        std::max(near.i_end, cell.i + reach + 1), std::max(near.j_end, cell.j + reach + 1)});
  const auto edge_m = static_cast<float>(package.grid().cell_edge_m);
  std::erase_if(overhead_, [&](const TriangleCorners& t) { return is_upright(t) || (is_cut && is_beyond_receivers(t, edge_m)); });
}

template <class Visit>
void OverhangGeometry::visit_surfaces(const CellRange& cells, Surfaces which, const Visit& visit) const {
  const Grid& grid = package_.grid();
  const CellRange range = cells.intersection(grid.cells);
  std::vector<TriangleCorners> triangles;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) {
    const TileView tile = package_.tile(range.cell_at(n));
    const Point2d shift_m = grid.corner_of(range.cell_at(n)) - grid.corner_of(cell_);
    const auto corner = [&](std::uint32_t v) { return placed(tile.mesh.vertices[v], shift_m); };
    std::uint32_t first = 0;
    for (const package::SurfaceRun& run : tile.surface_runs) {
      const package::SurfaceRecord& surface = tile.surfaces[run.surface];
      triangles.clear();
      if (surface.kind() != SurfaceKind::ground && surface.is_grounded() == (which == Surfaces::grounded))
        for (const Triangle& t : tile.mesh.triangles.subspan(first, run.end - first))
          triangles.push_back({corner(t.a), corner(t.b), corner(t.c)});
      first = run.end;
      if (!triangles.empty()) visit(triangles);
    }
  }
}

std::vector<OverhangGeometry::TriangleCorners> OverhangGeometry::overhanging_in(const CellRange& cells) const {
  std::vector<TriangleCorners> result;
  visit_surfaces(cells, Surfaces::overhanging, [&](const std::vector<TriangleCorners>& triangles) {
    result.insert(result.end(), triangles.begin(), triangles.end());
  });
  return result;
}

const OverhangFacets& OverhangGeometry::facets() {
  if (facets_) return *facets_;
  facets_.emplace();
  for (const TriangleCorners& t : overhanging_in(near_cells_of(package_.grid(), cell_))) facets_->add(t);
  return *facets_;
}

const OverhangFacets& OverhangGeometry::facets_around_recesses() {
  if (around_recesses_) return *around_recesses_;
  around_recesses_ = facets();
  // Recesses of the cell's receivers reach no farther than so beyond its border; the walls around them may
  constexpr auto reach_m = static_cast<float>(2.0 * most_recess_extent_m);
  const auto cell_m = static_cast<float>(package_.grid().cell_edge_m);
  const auto is_near = [&](const TriangleCorners& t) {
    const auto [low, high] = box_of(t);
    return std::max(low.x, low.y) <= cell_m + reach_m && std::min(high.x, high.y) >= -reach_m;
  };
  const CellRange around{cell_.i - 1, cell_.j - 1, cell_.i + 2, cell_.j + 2};
  visit_surfaces(around, Surfaces::grounded, [&](const std::vector<TriangleCorners>& triangles) {
    if (std::none_of(triangles.begin(), triangles.end(), is_near)) return;
    for (const TriangleCorners& t : triangles) around_recesses_->add(t);
  });
  return *around_recesses_;
}

PlacedScene OverhangGeometry::scene() {
  if (city_ != nullptr) return city_->seen_from(cell_);
  if (scene_) return {*scene_, {}};
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  for (const TriangleCorners& t : overhanging_in(near_cells_of(package_.grid(), cell_))) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), t.begin(), t.end());
    triangles.push_back({first, first + 1, first + 2});
  }
  return {scene_.emplace(std::move(vertices), std::move(triangles)), {}};
}

std::uint32_t OverhangGeometry::receivers_below(const ReceiverPacket& r) const {
  if (overhead_.empty()) return 0;
  const auto [west, east] = std::minmax_element(r.x.begin(), r.x.end());
  const auto [south, north] = std::minmax_element(r.y.begin(), r.y.end());
  const float lowest_z = r.lowest_z();
  std::uint32_t bits = 0;
  for (const TriangleCorners& t : overhead_) {
    const Box box = box_of(t);
    if (box.high.z <= lowest_z || box.high.x < *west || box.low.x > *east || box.high.y < *south || box.low.y > *north) continue;
    for (std::size_t l = 0; l < ReceiverPacket::lanes; ++l)
      if (is_above(t, r.x[l], r.y[l], r.z[l])) bits |= 1U << l;
  }
  return bits;
}

void NearHorizons::draw(const PacketHorizon& grounded, const OverhangEdges& near, const ReceiverPacket& receivers) {
  grounded_ = grounded;
  has_upper_ = !near.overhangs.empty();
  has_lower_ = !near.undersides.empty();
  if (has_upper_) {
    upper_.begin_above(grounded);
    upper_.raise(near.overhangs, receivers);
  }
  if (has_lower_) {
    lower_.set_slopes(grounded);
    lower_.raise(near.undersides, receivers);
  }
}

void OverhangHorizons::draw_overhangs(const CellOverhangs& overhangs, const ReceiverPacket& receivers, const Overhead& overhead,
                                      FarGapEnd far_end, const NearHorizons* near) {
  // First the far city by itself. Where no lower border of it is above the grounded horizon, it is joined with what is near
  upper_borders.raise(overhangs.far.overhangs, receivers);
  if (far_end == FarGapEnd::lowest && !overhangs.far.undersides.empty())
    lower_borders.set_to_lowest(overhangs.far.undersides, receivers, grounded);
  else
    lower_borders.raise(overhangs.far.undersides, receivers);
  grounded.join(lower_borders, upper_borders);
  far_lower_borders.set_slopes(lower_borders);
  far_upper_borders.set_slopes(upper_borders);
  // Then the near overhangs; a receiver below one sees no sky above it
  lower_borders.raise_to(grounded);
  if (near != nullptr) {
    upper_borders.raise_to(near->upper_borders());
    lower_borders.raise_to(near->lower_borders());
  } else {
    upper_borders.raise(overhangs.near.overhangs, receivers);
    lower_borders.raise(overhangs.near.undersides, receivers);
  }
  upper_borders.close(overhead.below);
  lower_borders.close(overhead.in_recess);
}

std::span<const PacketHorizon::Row> OverhangHorizons::find_sky_in_gaps(SkyWeight weight, const ReceiverPacket& receivers,
                                                                       std::vector<PacketHorizon::Row>& rows) {
  if (lower_borders.exceeds(grounded) == 0) return {};
  // The sky between grounded and lower borders; what is above the upper borders counts already
  lower_borders.lower_to(upper_borders);
  grounded.find_sky_below(lower_borders, weight, receivers, rows);
  // Less the far occluders in it, between their borders clamped to the gap
  far_lower_borders.raise_to(grounded);
  far_upper_borders.lower_to(lower_borders);
  far_upper_borders.raise_to(far_lower_borders);
  if (far_upper_borders.exceeds(far_lower_borders) == 0) return rows;
  far_lower_borders.find_sky_below(far_upper_borders, weight, receivers, far_sky_);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t l = 0; l < rows[k].size(); ++l) rows[k][l] = std::max(0.0F, rows[k][l] - far_sky_[k][l]);
  return rows;
}

}  // namespace farlod
