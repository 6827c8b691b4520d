// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/packed_city.hpp"

#include <stdlib.h>

#include <algorithm>
#include <string>

#include "farlod/expects.hpp"
#include "package/package_writer.hpp"

namespace farlod::scenes {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "farlod-test-XXXXXX").string();
  FARLOD_EXPECTS(mkdtemp(name.data()) != nullptr);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Grid grid_covering(const CityModel& city, Angle bearing, double cell_edge_m, int neighborhood, int block_edge) {
  Grid grid;
  grid.rotation = GridRotation(bearing);
  grid.cell_edge_m = exact_cell_edge_m(cell_edge_m);
  grid.neighborhood = neighborhood;
  grid.block_edge = block_edge;
  Box2d outline;
  for (const Point3d& p : city.points()) outline.add(grid.rotation.grid_from_city(horizontal(p)));
  const Cell low = grid.cell_of(outline.low), high = grid.cell_of(outline.high);
  grid.cells = {low.i, low.j, high.i + 1, high.j + 1};
  return grid;
}

void pack_city(const CityModel& city, const Grid& grid, const std::filesystem::path& folder, const FarMapSettings& far_map,
               Assign assign, const std::optional<std::vector<Cell>>& only) {
  Report report;
  const TileSet tiles = cut_into_tiles({city, {}}, grid, assign, std::nullopt, report);
  package::Manifest manifest;
  manifest.software = "test";
  manifest.height_origin_m = tiles.height_origin_m;
  manifest.grid = grid;
  manifest.assign = assign == Assign::clip ? "clip" : "whole";
  manifest.far_map_kind = "box";
  manifest.far_map_side_columns = far_map.side_columns;
  manifest.far_map_rows = far_map.rows;
  manifest.buildings = tiles.building_ids.size();
  const BoxMapBaker baker(tiles, grid, assign, far_map);
  PackageWriter writer(folder, Overwrite::refuse);
  for (const Block block : grid.blocks()) {
    const bool wanted = !only || std::any_of(only->begin(), only->end(), [&](Cell c) { return grid.block_of(c) == block; });
    std::vector<BakedMap> maps(static_cast<std::size_t>(grid.cells_of(block).size()));
    for (BakedMap& map : maps) map.shape.top = 0.0F;
    if (wanted) maps = baker.bake(block);
    manifest.blocks.push_back(writer.write_block(tiles, maps, grid, block, far_map));
  }
  writer.finish(manifest);
}

}  // namespace farlod::scenes
