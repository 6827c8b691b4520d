// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/run.hpp"
#include "farmap/far_map_baker.hpp"
#include "georeference/area_reader.hpp"
#include "package/existing_package.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"
#include "package/unfinished_package.hpp"

namespace farlod::pipeline {

/// The cells of a grid that an area meets.
struct AreaCells {
  std::vector<Cell> cells;                 ///< in the order of CellRange::index_of, each once
  std::size_t shapes_outside_of_grid = 0;  ///< points, lines and polygons that meet no cell
};

/// The area is in the city frame.
///   (1) a point meets the cell that holds it: on a border, the one to its east or north
///   (2) a line meets the cells that it runs through
///   (3) a polygon meets the cells that its rings run through, and those that it covers; a cell within a hole is not met
[[nodiscard]] AreaCells cells_met_by(const Area& area_city, const Grid& grid);

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

/// No far maps but those that are there.
[[nodiscard]] BlockPlan plan_none(const Grid& grid, const ExistingPackage* existing);

/// Far maps for the area's cells, and those that have far maps in the package that is there. Throws InputError when the area has
/// no place in the CRS of the package, and InvalidArgument when it meets no cell.
[[nodiscard]] BlockPlan plan_area(const georeference::RequestedArea& area, const Georeference& georeference, const Grid& grid,
                                  const ExistingPackage* existing);

/// The far maps that a block has afterwards.
[[nodiscard]] std::size_t far_maps_of(const PlannedBlock& planned, const Grid& grid);

/// What it costs to make each block of the plan: seconds of one core, about. 0 for blocks that are kept.
[[nodiscard]] std::vector<double> costs_of(const BlockPlan& plan, const TileSet& tiles, const Grid& grid);

/// What the making of blocks took, and what came of it.
struct BlockTally {
  double bake_s = 0.0, write_s = 0.0;  ///< shares of the wall clock
  std::uint64_t far_map_bytes = 0;     ///< of the far maps that were baked
  std::size_t found = 0;               ///< blocks that were finished already
};

/// From what blocks are made.
struct BlockSource {
  const TileSet& tiles;
  const Grid& grid;
  const package::FarMapShape& shape;
  const FarMapBaker* baker = nullptr;  ///< none where no block needs far maps
};

/// Bakes and writes the blocks of a plan that these places name, as far as they are not finished yet, several at a time: while
/// one is written, another one is baked. Each is recorded when it is on the disk. Throws OutputError, Cancelled.
BlockTally make_blocks(const BlockSource& source, const BlockPlan& plan, std::span<const std::size_t> places,
                       const UnfinishedPackage& unfinished, const RunSettings& run, std::size_t blocks_at_once);

}  // namespace farlod::pipeline
