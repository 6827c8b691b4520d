// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "farlod/inspection.hpp"
#include "package/far_map.hpp"
#include "run/existing_cell.hpp"
#include "run/package_contents.hpp"
#include "scene/vertical_profile.hpp"

namespace farlod {
namespace {

constexpr float eye_height_m = 1.5F;

/// Clockwise from true north, of a direction that is `turn` counter-clockwise from the x axis of the grid frame.
Angle true_azimuth(const package::Manifest& m, Angle turn) {
  return Angle::degrees(90.0) - turn + m.grid.rotation.bearing() + m.convergence;
}

Point3d projected(const package::Manifest& m, Cell cell, const Point3f& p_cell) {
  const Point2d corner = m.grid.corner_of(cell);
  return m.projected_from_grid({corner.x + p_cell.x, corner.y + p_cell.y, m.height_origin_m + p_cell.z});
}

/// In the middle of the cell, above the ground, or above the lowest point of the tile where there is no ground.
Point3f eye_in(const PackageReader& reader, Cell cell) {
  const auto middle = static_cast<float>(0.5 * reader.grid().cell_edge_m);
  const package::CellRecord record = *reader.tile(cell).cell;
  const float low_m = record.z_low_m <= record.z_high_m ? record.z_low_m : 0.0F;
  const float ground_m = PointLocator(reader, cell).at(middle, middle).ground_m().value_or(low_m);
  return {middle, middle, ground_m + eye_height_m};
}

/// The estimate between two floors, held between the bounds.
std::vector<float> estimate_at(const FarHorizon& map, std::uint32_t patch, float z_m) {
  const auto [above, share] = map.floor_above(patch, z_m);
  const auto low = map.row(map.low, patch), high = map.row(map.high, patch);
  const auto floor = map.row(map.estimate, patch), next = map.row(map.estimate, above);
  std::vector<float> estimate(floor.size());
  for (std::size_t n = 0; n < floor.size(); ++n)
    estimate[n] = std::clamp(floor[n] + std::min(share, 1.0F) * (next[n] - floor[n]), low[n], high[n]);
  return estimate;
}

/// Bins run counter-clockwise in the grid frame, views clockwise.
std::vector<float> clockwise(std::span<const float> bins) { return {bins.rbegin(), bins.rend()}; }

void add_edges(const PackageReader& reader, Cell cell, const FarHorizon& map, std::uint32_t patch, FarHorizonView& view) {
  const std::uint32_t square = patch % map.patches.squares(), layer = patch / map.patches.squares();
  const Point2d shift = map.occluders.cell_from_block_m;
  const auto placed = [&](const Point3f& p_block) {
    const Point3f p_cell{p_block.x + static_cast<float>(shift.x), p_block.y + static_cast<float>(shift.y), p_block.z};
    return projected(reader.manifest(), cell, p_cell);
  };
  for (const package::ExplicitOccluder& occluder : map.occluders.explicit_edges) {
    if (((occluder.squares >> square) & (occluder.layers >> layer) & 1U) == 0) continue;
    const HorizonEdge& e = map.occluders.edges[occluder.row];
    view.edges.push_back({placed(e.a), placed(e.b)});
  }
}

FarView horizon_view(const PackageReader& reader, Cell cell) {
  const package::Manifest& m = reader.manifest();
  const FarHorizon map = reader.far_horizon(cell);
  const Point3f eye = eye_in(reader, cell);
  // Below the lowest level the map knows nothing; what it says there is what comes nearest
  const std::uint32_t patch = map.patches.patch_of({eye.x, eye.y, std::max(eye.z, map.patches.levels_m().front())}).value_or(0);
  FarView view{projected(m, cell, eye), {}, {}};
  // The last bin ends where the first one begins, and comes first when they run the other way
  view.horizon.first_azimuth = true_azimuth(m, Angle::radians(2.0 * std::numbers::pi));
  view.horizon.low = clockwise(map.row(map.low, patch));
  view.horizon.high = clockwise(map.row(map.high, patch));
  view.horizon.estimate = clockwise(estimate_at(map, patch, eye.z));
  add_edges(reader, cell, map, patch, view.horizon);
  return view;
}

FarView box_view(const PackageReader& reader, Cell cell) {
  const package::Manifest& m = reader.manifest();
  const package::CellRecord record = *reader.tile(cell).cell;
  FarView view{projected(m, cell, {record.capture_x_m, record.capture_y_m, record.capture_z_m}), {}, {}};
  const BoxFarMap map = reader.box_far_map(cell);
  FarBoxView& box = view.box;
  box.north_azimuth = true_azimuth(m, Angle::degrees(90.0));
  box.side_columns = m.far_map.side_columns;
  box.rows = m.far_map.rows;
  box.top = record.far_map_top;
  const BoxMap shape{m.far_map.side_columns, m.far_map.rows, std::max(record.far_map_top, 1.0F)};
  const std::uint32_t columns = shape.columns();
  for (std::uint32_t row = 0; row < shape.rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      // Sides run counter-clockwise from the east: the north one ends with column 2·W − 1, which is the first when they run back
      const std::uint32_t stored = (2 * shape.side_columns + columns - 1 - column) % columns;
      box.distance_m.push_back(map.distance_m(shape.direction_of({stored, row})));
    }
  return view;
}

}  // namespace

std::optional<FarView> far_view_of(const Package& package, CellPlace place) {
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const Cell cell = existing_cell(reader.grid(), place);
  if (!reader.has_far_map(cell)) return std::nullopt;
  return reader.manifest().far_map.is_box() ? box_view(reader, cell) : horizon_view(reader, cell);
}

}  // namespace farlod
