// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/near_buildings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/cancellation.hpp"
#include "base/grid.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "occlusion/placed_mesh.hpp"
#include "package/layout.hpp"
#include "scene/plan_index.hpp"
#include "scene/vertical_profile.hpp"

namespace farlod {
namespace {

/// A distance in the plan. Beyond two squares, float decides; between them, the exact distance does.
struct Nearness {
  double distance_m, square_m2;
  float surely_near_m2, surely_far_m2;

  explicit Nearness(double distance)
      : distance_m(distance),
        square_m2(distance * distance),
        surely_near_m2(static_cast<float>(square_m2) * (1.0F - 1e-5F)),
        surely_far_m2(static_cast<float>(square_m2) * (1.0F + 1e-5F)) {}
};

/// Roofs and walls of buildings as triangles, in the frame of the receivers' cell.
struct BuildingPieces {
  std::vector<PlanTriangle> corners;
  std::vector<PlanOutline> outlines;
};

PlanOutline outline_of(std::span<const Receiver> receivers, std::span<const std::uint32_t> numbers) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  PlanOutline outline{infinity, -infinity, infinity, -infinity};
  for (const std::uint32_t n : numbers) {
    const Point3f& p = receivers[n].p_cell;
    outline = {std::min(outline.west, p.x), std::max(outline.east, p.x), std::min(outline.south, p.y),
               std::max(outline.north, p.y)};
  }
  return outline;
}

bool are_far(const PlanOutline& a, const PlanOutline& b, const Nearness& near) {
  const float x = std::max(std::max(a.west - b.east, b.west - a.east), 0.0F);
  const float y = std::max(std::max(a.south - b.north, b.south - a.north), 0.0F);
  return x * x + y * y > near.surely_far_m2;
}

/// Whether a corner is near each point of a rectangle.
bool is_near_all_of(const PlanOutline& rectangle, const PlanTriangle& corners, const Nearness& near) {
  return std::ranges::any_of(corners, [&](const Point3f& corner) {
    const float x = std::max(corner.x - rectangle.west, rectangle.east - corner.x);
    const float y = std::max(corner.y - rectangle.south, rectangle.north - corner.y);
    return x * x + y * y <= near.surely_near_m2;
  });
}

/// A corner can be near all of a rectangle that is as small as this.
bool is_small(const PlanOutline& rectangle, const Nearness& near) {
  const float x = rectangle.east - rectangle.west, y = rectangle.north - rectangle.south;
  return x * x + y * y <= 4.0F * near.surely_near_m2;
}

bool is_near_segment(Point2d p, Point2d a, Point2d b, const Nearness& near) {
  const Point2d ab = b - a, ap = p - a;
  const double length2 = dot(ab, ab);
  const double along = length2 > 0.0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0.0;
  const Point2d off = ap - along * ab;
  return dot(off, off) <= near.square_m2;
}

bool is_near(const PlanTriangle& corners, const Point3f& receiver, const Nearness& near) {
  const auto in_plan = [](const Point3f& p) { return Point2d{p.x, p.y}; };
  for (std::size_t n = 0; n < 3; ++n)
    if (is_near_segment(in_plan(receiver), in_plan(corners[n]), in_plan(corners[(n + 1) % 3]), near)) return true;
  return covers(corners, receiver.x, receiver.y);
}

/// Floors and what closes gaps lie below roofs.
bool is_of_roof_or_wall(const package::SurfaceRecord& surface) {
  return surface.building != package::no_building && (surface.kind() == SurfaceKind::roof || surface.kind() == SurfaceKind::wall);
}

void add_pieces(const TileView& tile, Point2d shift_m, const PlanOutline& receivers, const Nearness& near,
                BuildingPieces& pieces) {
  std::uint32_t t = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    if (!is_of_roof_or_wall(tile.surfaces[run.surface])) t = run.end;
    for (; t < run.end; ++t) {
      const Triangle& numbers = tile.mesh.triangles[t];
      const auto corner = [&](std::size_t n) { return placed(tile.mesh.vertices[numbers.corner(n)], shift_m); };
      const PlanTriangle corners{corner(0), corner(1), corner(2)};
      const PlanOutline outline = outline_of(corners);
      if (are_far(outline, receivers, near)) continue;
      pieces.corners.push_back(corners);
      pieces.outlines.push_back(outline);
    }
  }
}

/// What may be near receivers of a cell.
BuildingPieces pieces_around(const PackageReader& package, Cell cell, const PlanOutline& receivers, const Nearness& near) {
  const Grid& grid = package.grid();
  const bool are_whole = package.manifest().assign == "whole";
  const std::int32_t r = static_cast<std::int32_t>(std::ceil(near.distance_m / grid.cell_edge_m)) +
                         (are_whole ? TrianglesOfCell::reach_of_whole_buildings : 0);
  const CellRange range = CellRange{cell.i - r, cell.j - r, cell.i + r + 1, cell.j + r + 1}.intersection(grid.cells);
  BuildingPieces pieces;
  for (std::size_t n = 0; n < static_cast<std::size_t>(range.size()); ++n) {
    const Cell there = range.cell_at(n);
    add_pieces(package.tile(there), grid.corner_of(there) - grid.corner_of(cell), receivers, near, pieces);
  }
  return pieces;
}

/// Halves the receivers until a building is near all of them, or near none, or they are few.
class ReceiversNearBuildings {
 public:
  ReceiversNearBuildings(const PackageReader& package, const CellReceivers& cell, double distance_m, const std::stop_token& stop)
      : near_(distance_m), receivers_(cell.receivers), stop_(stop), is_near_(receivers_.size()), numbers_(receivers_.size()) {
    std::iota(numbers_.begin(), numbers_.end(), 0U);
    pieces_ = pieces_around(package, cell.cell, outline_of(receivers_, numbers_), near_);
  }

  [[nodiscard]] std::vector<bool> find() && {
    std::vector<std::uint32_t> all(pieces_.corners.size());
    std::iota(all.begin(), all.end(), 0U);
    divide(numbers_, all);
    return std::move(is_near_);
  }

 private:
  static constexpr std::size_t few = 8;

  void divide(std::span<std::uint32_t> numbers, std::span<const std::uint32_t> candidates) {
    throw_if_cancelled(stop_);
    const PlanOutline outline = outline_of(receivers_, numbers);
    const bool may_be_all = is_small(outline, near_);
    std::vector<std::uint32_t> pieces;
    for (const std::uint32_t n : candidates) {
      if (are_far(pieces_.outlines[n], outline, near_)) continue;
      if (may_be_all && is_near_all_of(outline, pieces_.corners[n], near_)) return set_all(numbers);
      pieces.push_back(n);
    }
    if (pieces.empty()) return;
    if (numbers.size() <= few) return ask_each(numbers, pieces);
    const std::size_t half = divided(numbers, outline);
    // All that stand on one place are few, however many they are
    if (half == 0 || half == numbers.size()) return ask_each(numbers, pieces);
    divide(numbers.first(half), pieces);
    divide(numbers.subspan(half), pieces);
  }
  /// Sorts the receivers by the half of the outline that they are in. Returns how many are in the first.
  [[nodiscard]] std::size_t divided(std::span<std::uint32_t> numbers, const PlanOutline& outline) const {
    const bool is_wide = outline.east - outline.west > outline.north - outline.south;
    const float middle = 0.5F * (is_wide ? outline.west + outline.east : outline.south + outline.north);
    const auto rest = std::partition(numbers.begin(), numbers.end(), [&](std::uint32_t n) {
      return (is_wide ? receivers_[n].p_cell.x : receivers_[n].p_cell.y) < middle;
    });
    return static_cast<std::size_t>(rest - numbers.begin());
  }
  void set_all(std::span<const std::uint32_t> numbers) {
    for (const std::uint32_t n : numbers) is_near_[n] = true;
  }
  void ask_each(std::span<const std::uint32_t> numbers, std::span<const std::uint32_t> pieces) {
    for (const std::uint32_t n : numbers)
      is_near_[n] =
          std::ranges::any_of(pieces, [&](std::uint32_t k) { return is_near(pieces_.corners[k], receivers_[n].p_cell, near_); });
  }

  Nearness near_;
  std::span<const Receiver> receivers_;
  const std::stop_token& stop_;
  std::vector<bool> is_near_;
  std::vector<std::uint32_t> numbers_;
  BuildingPieces pieces_;
};

}  // namespace

std::vector<bool> are_near_buildings(const PackageReader& package, const CellReceivers& cell, double distance_m,
                                     const std::stop_token& stop) {
  if (cell.receivers.empty() || package.manifest().buildings == 0) return {};
  return ReceiversNearBuildings(package, cell, distance_m, stop).find();
}

}  // namespace farlod
