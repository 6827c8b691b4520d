// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/grid.hpp"
#include "city/located_city.hpp"
#include "georeference/area_reader.hpp"
#include "package/existing_package.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"

namespace farlod::pipeline {

/// What a run does with a block.
struct PlannedBlock {
  Block block;
  std::optional<package::CellRuns> mapped;       ///< the cells that have far maps afterwards; all when absent
  std::optional<package::BlockFiles> kept = {};  ///< its files, where the package that is there has all of these far maps
};

struct BlockPlan {
  std::vector<PlannedBlock> blocks;        ///< in the order of Grid::blocks()
  std::uint64_t far_maps = 0;              ///< to bake: those of a block that gets more are baked again, since they share edges
  std::size_t shapes_outside_of_grid = 0;  ///< points, lines and polygons of an area that meet no cell
};

/// Far maps for all cells. Of a package that is there, the blocks are kept that have them, and whose files are whole.
[[nodiscard]] BlockPlan plan_all(const Grid& grid, const ExistingPackage* existing);

/// Far maps for the area's cells, and those that have far maps in the package that is there. Throws InputError when the area has
/// no place in the CRS of the package, and InvalidArgument when it meets no cell.
[[nodiscard]] BlockPlan plan_area(const georeference::RequestedArea& area, const Georeference& georeference, const Grid& grid,
                                  const ExistingPackage* existing);

/// The far maps that a block has afterwards.
[[nodiscard]] std::size_t far_maps_of(const PlannedBlock& planned, const Grid& grid);

/// What it costs to make each block of the plan: seconds of one core, about. 0 for blocks that are kept.
[[nodiscard]] std::vector<double> costs_of(const BlockPlan& plan, const TileSet& tiles, const Grid& grid);

}  // namespace farlod::pipeline
