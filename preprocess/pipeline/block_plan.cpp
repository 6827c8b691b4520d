// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/block_plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "align/area_cells.hpp"
#include "base/grid_outline.hpp"
#include "farlod/error.hpp"
#include "pipeline/pack_estimate.hpp"

namespace farlod::pipeline {
namespace {

std::string extent_text(const Box2d& box, Point2d origin) {
  return fmt::format("from {:.1f},{:.1f} to {:.1f},{:.1f}", box.low.x + origin.x, box.low.y + origin.y, box.high.x + origin.x,
                     box.high.y + origin.y);
}

/// The cells of the block that have far maps afterwards; absent where all have one.
std::optional<package::CellRuns> with_existing(std::vector<std::size_t> places, const package::BlockFiles* there,
                                               std::size_t cell_count) {
  if (there != nullptr && !there->mapped) return std::nullopt;
  if (there != nullptr) {
    const std::vector<std::size_t> old = there->mapped->places();
    places.insert(places.end(), old.begin(), old.end());
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (places.size() == cell_count) return std::nullopt;
  return package::CellRuns::of(places);
}

/// `mapped_of(n, block, there)`: the cells of the n-th block that have far maps afterwards.
template <class MappedOf>
BlockPlan plan_blocks(const Grid& grid, const ExistingPackage* existing, const MappedOf& mapped_of) {
  BlockPlan plan;
  const std::vector<Block> blocks = grid.blocks();
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const package::BlockFiles* there = existing != nullptr ? &existing->blocks()[n] : nullptr;
    PlannedBlock planned{blocks[n], mapped_of(blocks[n], there)};
    if (there != nullptr && there->mapped == planned.mapped && existing->is_whole(*there)) planned.kept = *there;
    if (!planned.kept) plan.far_maps += far_maps_of(planned, grid);
    plan.blocks.push_back(std::move(planned));
  }
  return plan;
}

/// Writing a triangle of the tiles on one core. Measured as those of pack_estimate.cpp.
constexpr double seconds_per_written_triangle = 5e-7;

}  // namespace

std::size_t far_maps_of(const PlannedBlock& planned, const Grid& grid) {
  return planned.mapped ? planned.mapped->size() : static_cast<std::size_t>(grid.cells_of(planned.block).size());
}

BlockPlan plan_all(const Grid& grid, const ExistingPackage* existing) {
  return plan_blocks(grid, existing,
                     [](Block, const package::BlockFiles*) -> std::optional<package::CellRuns> { return std::nullopt; });
}

BlockPlan plan_area(const georeference::RequestedArea& area, const Georeference& georeference, const Grid& grid,
                    const ExistingPackage* existing) {
  const Area area_city = georeference::located(area, georeference);
  const align::AreaCells met = align::cells_met_by(area_city, grid);
  if (met.cells.empty())
    throw InvalidArgument(area.name + " meets no cell of the grid: it reaches " +
                          extent_text(outline_of(area_city), georeference.origin_m) + ", and the city " +
                          extent_text(outline_city(grid), georeference.origin_m) + " (" + georeference.crs_name +
                          "): check its coordinates, and their CRS");
  std::map<Block, std::vector<std::size_t>> places;
  for (const Cell cell : met.cells) {
    const Block block = grid.block_of(cell);
    places[block].push_back(grid.cells_of(block).index_of(cell));
  }
  BlockPlan plan = plan_blocks(grid, existing, [&](Block block, const package::BlockFiles* there) {
    return with_existing(places[block], there, static_cast<std::size_t>(grid.cells_of(block).size()));
  });
  plan.shapes_outside_of_grid = met.shapes_outside_of_grid;
  return plan;
}

std::vector<double> costs_of(const BlockPlan& plan, const TileSet& tiles, const Grid& grid) {
  std::vector<double> costs;
  for (const PlannedBlock& planned : plan.blocks) {
    double cost = seconds_per_far_map * static_cast<double>(far_maps_of(planned, grid));
    const CellRange cells = grid.cells_of(planned.block);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
      cost += seconds_per_written_triangle * static_cast<double>(tiles.tile(cells.cell_at(n)).triangles.size());
    costs.push_back(planned.kept ? 0.0 : cost);
  }
  return costs;
}

}  // namespace farlod::pipeline
