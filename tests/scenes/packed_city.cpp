// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/packed_city.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <span>

#include "farmap/far_map_baker.hpp"
#include "package/package_writer.hpp"

namespace farlod::scenes {
namespace {

/// Far maps that hide nothing.
BakedBlock empty_maps(std::size_t cells, const Grid& grid, const FarMapSettings& far_map) {
  if (far_map.kind == FarMapKind::box) {
    BakedBoxes boxes(cells);
    for (BakedBox& map : boxes) map.shape.top = 0.0F;
    return boxes;
  }
  const HorizonMapSettings& h = far_map.horizon;
  const ReceiverPatches patches(grid.cell_edge_m, h.squares_per_edge, std::vector<float>(h.layers, 0.0F));
  const std::vector<float> nothing(static_cast<std::size_t>(patches.count()) * h.azimuth_bins, 0.0F);
  return BakedHorizons{{}, {cells, BakedHorizon{patches, {}, nothing, nothing, nothing, nothing}}};
}

Grid with_block_edge(Grid grid, int block_edge) {
  grid.block_edge = block_edge;
  return grid;
}

/// Puts the map of one cell in its place among those of its block, whose frame begins elsewhere.
void put(BakedBoxes& block, BakedBoxes&& single, std::size_t place, const Point3f&) { block[place] = std::move(single[0]); }
void put(BakedHorizons& block, BakedHorizons&& single, std::size_t place, const Point3f& block_from_cell_m) {
  BakedHorizon& map = single.cells[0];
  for (package::ExplicitOccluder& n : map.explicit_edges) n.row += static_cast<std::uint32_t>(block.edges.size());
  for (const HorizonEdge& e : single.edges)
    block.edges.push_back({e.a + block_from_cell_m, e.b + block_from_cell_m, e.adjacent, e.role});
  block.cells[place] = std::move(map);
}

/// Bakes far maps block by block, or one by one where few of a block are asked for.
class ChosenMaps {
 public:
  ChosenMaps(const TileSet& tiles, const Grid& grid, Assign assign, const FarMapSettings& far_map, const ChosenCells& only)
      : grid_(grid),
        single_cells_(with_block_edge(grid, 1)),
        far_map_(far_map),
        only_(only),
        blocks_baker_(tiles, grid_, assign, far_map),
        cells_baker_(tiles, single_cells_, assign, far_map) {}

  [[nodiscard]] std::vector<Cell> chosen_of(Block block) const {
    std::vector<Cell> chosen;
    const CellRange cells = grid_.cells_of(block);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
      if (!only_ || std::binary_search(only_->begin(), only_->end(), cells.cell_at(n))) chosen.push_back(cells.cell_at(n));
    return chosen;
  }

  [[nodiscard]] BakedBlock bake(Block block, std::span<const Cell> chosen) const {
    const CellRange cells = grid_.cells_of(block);
    if (chosen.size() == static_cast<std::size_t>(cells.size())) return blocks_baker_.bake(block);
    BakedBlock maps = empty_maps(static_cast<std::size_t>(cells.size()), grid_, far_map_);
    std::vector<BakedBlock> singles(chosen.size());
    oneapi::tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t n) {
      singles[n] = cells_baker_.bake({chosen[n].i, chosen[n].j});
    });
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      const Point2d from = grid_.corner_of(chosen[n]) - grid_.corner_of({cells.i_begin, cells.j_begin});
      const Point3f block_from_cell_m{static_cast<float>(from.x), static_cast<float>(from.y), 0.0F};
      std::visit(
          [&]<class Maps>(Maps& all) {
            put(all, std::get<Maps>(std::move(singles[n])), cells.index_of(chosen[n]), block_from_cell_m);
          },
          maps);
    }
    return maps;
  }

 private:
  const Grid& grid_;
  Grid single_cells_;
  FarMapSettings far_map_;
  const ChosenCells& only_;
  FarMapBaker blocks_baker_, cells_baker_;
};

package::Manifest manifest_of(const TileSet& tiles, const Grid& grid, const FarMapSettings& far_map, Assign assign) {
  package::Manifest manifest;
  manifest.software = "test";
  manifest.height_origin_m = tiles.height_origin_m;
  manifest.grid = grid;
  manifest.assign = assign == Assign::clip ? "clip" : "whole";
  manifest.far_map = shape_of(far_map);
  manifest.buildings = tiles.building_ids.size();
  return manifest;
}

}  // namespace

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

FarMapCost pack_tiles(const TileSet& tiles, const Grid& grid, const std::filesystem::path& folder, const FarMapSettings& far_map,
                      Assign assign, const ChosenCells& only) {
  package::Manifest manifest = manifest_of(tiles, grid, far_map, assign);
  const ChosenMaps maps(tiles, grid, assign, far_map, only);
  PackageWriter writer(folder);
  FarMapCost cost;
  for (const Block block : grid.blocks()) {
    const std::vector<Cell> chosen = maps.chosen_of(block);
    const auto start = std::chrono::steady_clock::now();
    const BakedBlock baked = maps.bake(block, chosen);
    cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    cost.cells += chosen.size();
    const std::uint64_t bytes_before = writer.far_map_bytes();
    manifest.blocks.push_back(writer.write_block(tiles, baked, grid, block, manifest.far_map));
    if (chosen.size() != static_cast<std::size_t>(grid.cells_of(block).size())) continue;
    cost.cells_of_whole_blocks += chosen.size();
    cost.bytes_of_whole_blocks += writer.far_map_bytes() - bytes_before;
  }
  writer.write_manifest(manifest);
  return cost;
}

void pack_city(const CityModel& city, const Grid& grid, const std::filesystem::path& folder, const FarMapSettings& far_map,
               Assign assign, const ChosenCells& only) {
  Report report;
  pack_tiles(tiles::cut_into_tiles({city, {}}, grid, assign, std::nullopt, report), grid, folder, far_map, assign, only);
}

}  // namespace farlod::scenes
