// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/plan_view.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <compare>
#include <limits>
#include <utility>

#include "base/run_settings.hpp"
#include "receivers/raster_receivers.hpp"
#include "run/cells_in_parallel.hpp"
#include "run/memory_limit.hpp"
#include "run/package_contents.hpp"
#include "run/usable_view.hpp"
#include "scene/plan_index.hpp"

namespace farlod {
namespace {

/// A side of a roof's triangle in the plan, the same whichever way it runs.
struct RoofSide {
  std::uint32_t building = 0;
  std::array<float, 2> a{}, b{};
  auto operator<=>(const RoofSide&) const = default;
};

/// What one cell adds to the outlines.
struct CellOutlines {
  std::vector<PlanSegment> segments;
  double roof_area_m2 = 0.0, length_m = 0.0;
};

/// Where the grid cuts a roof, it has no edge. A wall that stands there within a millimetre is lost with it.
bool lies_on_border(const RoofSide& side, float cell_edge_m) {
  constexpr float tolerance_m = 0.001F;
  for (const std::size_t axis : {0U, 1U})
    for (const float border : {0.0F, cell_edge_m})
      if (std::abs(side.a[axis] - border) < tolerance_m && std::abs(side.b[axis] - border) < tolerance_m) return true;
  return false;
}

std::vector<RoofSide> roof_sides(const TileView& tile, double& roof_area_m2) {
  std::vector<RoofSide> sides;
  std::uint32_t begin = 0;
  for (const package::SurfaceRun& run : tile.surface_runs) {
    const package::SurfaceRecord& surface = tile.surfaces[run.surface];
    for (std::uint32_t t = begin; surface.kind() == SurfaceKind::roof && t < run.end; ++t) {
      const Triangle& corners = tile.mesh.triangles[t];
      const PlanTriangle triangle{tile.mesh.vertices[corners.a], tile.mesh.vertices[corners.b], tile.mesh.vertices[corners.c]};
      const double area = std::abs(plan_area(triangle));
      if (!(area > 0.0)) continue;
      roof_area_m2 += 0.5 * area;
      for (std::size_t n = 0; n < 3; ++n) {
        const Point3f &from = triangle[n], &to = triangle[(n + 1) % 3];
        RoofSide side{tile.building_number(surface), {from.x, from.y}, {to.x, to.y}};
        if (side.b < side.a) std::swap(side.a, side.b);
        sides.push_back(side);
      }
    }
    begin = run.end;
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// The sides that belong to one triangle of the building's roof: two triangles that meet have no outline between them, also where
/// one of them is higher.
CellOutlines outlines_in(const PackageReader& reader, Cell cell, const Box2d& part) {
  const package::Manifest& m = reader.manifest();
  const Point2d corner = m.grid.corner_of(cell);
  CellOutlines result;
  const std::vector<RoofSide> sides = roof_sides(reader.tile(cell), result.roof_area_m2);
  for (auto side = sides.begin(); side != sides.end();) {
    const auto next = std::find_if(side, sides.end(), [&](const RoofSide& s) { return s != *side; });
    const bool is_outline = next - side == 1 && !lies_on_border(*side, static_cast<float>(m.grid.cell_edge_m));
    const auto placed = [&](const std::array<float, 2>& p) {
      return horizontal(m.projected_from_grid({corner.x + p[0], corner.y + p[1], 0.0}));
    };
    const PlanSegment segment{placed(side->a), placed(side->b)};
    side = next;
    if (!is_outline) continue;
    result.length_m += norm(segment.b - segment.a);
    const Box2d around{{std::min(segment.a.x, segment.b.x), std::min(segment.a.y, segment.b.y)},
                       {std::max(segment.a.x, segment.b.x), std::max(segment.a.y, segment.b.y)}};
    if (around.low.x <= part.high.x && part.low.x <= around.high.x && around.low.y <= part.high.y && part.low.y <= around.high.y)
      result.segments.push_back(segment);
  }
  return result;
}

std::vector<Cell> cells_meeting(const package::Manifest& m, const Box2d& part) {
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.grid.cells.size()); ++n) {
    const Cell cell = m.grid.cells.cell_at(n);
    const Box2d outline = m.projected_outline(m.grid.square_of(cell));
    if (outline.low.x <= part.high.x && part.low.x <= outline.high.x && outline.low.y <= part.high.y &&
        part.low.y <= outline.high.y)
      cells.push_back(cell);
  }
  return cells;
}

BuildingOutlines joined(const std::vector<CellOutlines>& cells) {
  BuildingOutlines all;
  double area_m2 = 0.0, length_m = 0.0;
  for (const CellOutlines& cell : cells) {
    all.segments.insert(all.segments.end(), cell.segments.begin(), cell.segments.end());
    area_m2 += cell.roof_area_m2;
    length_m += cell.length_m;
  }
  if (length_m > 0.0) all.typical_edge_m = 4.0 * area_m2 / length_m;
  return all;
}

constexpr const char* smaller_part = "choose a smaller part";

void require_usable_part(const Box2d& part) {
  for (const double x : {part.low.x, part.low.y, part.high.x, part.high.y}) require_coordinate("a coordinate of the part", x);
  if (part.empty()) throw InvalidArgument("the part is empty: its low corner must lie south-west of its high corner");
}

/// Which heights are looked up.
enum class Wanted : std::uint8_t { ground, ground_and_highest };

PlanHeights heights_in(const Package& package, const RasterPlan& plan, const RunSettings& run, Wanted wanted) {
  require_usable(run);
  require_usable_view(plan);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const std::size_t count = plan.columns * plan.rows, highest = wanted == Wanted::ground ? 0 : count;
  require_memory(run, static_cast<double>((count + highest) * sizeof(float) + bytes_of_blocks_at_work(reader.manifest())),
                 "looking up heights", smaller_part);
  PlanHeights heights{std::vector<float>(count, std::numeric_limits<float>::quiet_NaN()),
                      std::vector<float>(highest, std::numeric_limits<float>::quiet_NaN())};
  const RasterReceivers pixels(reader.manifest(), plan);
  const std::vector<Cell> cells = pixels.cells();
  const auto origin_m = static_cast<float>(reader.manifest().height_origin_m);
  for_each_cell(cells.size(), run, "heights", [&](std::size_t n) {
    // Each pixel is of one cell alone
    pixels.for_each_profile(reader, cells[n], run.stop, [&](std::size_t pixel, const VerticalProfile& profile) {
      if (const auto ground_m = profile.ground_m()) heights.ground_m[pixel] = *ground_m + origin_m;
      if (highest == 0) return;
      if (const auto highest_m = profile.highest_m()) heights.highest_m[pixel] = *highest_m + origin_m;
    });
  });
  return heights;
}

}  // namespace

std::optional<BuildingOutlines> building_outlines(const Package& package, const Box2d& part, std::size_t most_segments,
                                                  const RunSettings& run) {
  require_usable(run);
  require_usable_part(part);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const double bytes =
      2.0 * static_cast<double>(std::min(most_segments, reader.manifest().triangles * std::size_t{3})) * sizeof(PlanSegment);
  require_memory(run, bytes + static_cast<double>(bytes_of_blocks_at_work(reader.manifest())), "drawing outlines", smaller_part);
  const std::vector<Cell> cells = cells_meeting(reader.manifest(), part);
  std::vector<CellOutlines> outlines(cells.size());
  std::atomic<std::size_t> segments = 0;
  for_each_cell(cells.size(), run, "outlines", [&](std::size_t n) {
    // Whether there are too many does not depend on which cells come first
    if (segments > most_segments) return;
    outlines[n] = outlines_in(reader, cells[n], part);
    segments += outlines[n].segments.size();
  });
  if (segments > most_segments) return std::nullopt;
  return joined(outlines);
}

std::vector<float> ground_heights(const Package& package, const RasterPlan& plan, const RunSettings& run) {
  return heights_in(package, plan, run, Wanted::ground).ground_m;
}

PlanHeights plan_heights(const Package& package, const RasterPlan& plan, const RunSettings& run) {
  return heights_in(package, plan, run, Wanted::ground_and_highest);
}

}  // namespace farlod
