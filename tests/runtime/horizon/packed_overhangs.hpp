// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>

#include "horizon/overhangs.hpp"
#include "package/package_reader.hpp"
#include "tests/scenes/packed_city.hpp"

namespace farlod {

/// A package of two cells, of which one owns some triangles of a building that can be seen under, wherever they lie; the ground
/// beside them hangs over nobody.
class PackedOverhangs {
 public:
  static constexpr Cell cell{0, 0}, south_of_it{0, -1};

  /// The triangles are in the frame of their owner. Those of whole buildings may lie anywhere.
  explicit PackedOverhangs(std::span<const std::array<Point3f, 3>> triangles, Assign assign = Assign::whole, Cell owner = cell)
      : package_(packed(triangles, assign, owner)) {}
  [[nodiscard]] OverhangGeometry geometry() const { return {package_, cell}; }

 private:
  [[nodiscard]] PackageReader packed(std::span<const std::array<Point3f, 3>> triangles, Assign assign, Cell owner) const {
    Grid grid;
    grid.cell_edge_m = 20.0;
    grid.neighborhood = 1;
    grid.cells = {0, -1, 1, 1};
    TileSet tiles;
    tiles.cells = grid.cells;
    tiles.tiles.resize(2);
    tiles.building_ids = {"overhanging", "grounded"};
    tiles.surfaces = {{ground_building, 0, 0, SurfaceKind::ground, {0, 0, 1}, 8.0},
                      {0, 0, 0, SurfaceKind::roof, {0, 0, 1}, 8.0, false},
                      {1, 0, 0, SurfaceKind::roof, {0, 0, 1}, 8.0, true}};
    Tile& tile = tiles.tile(owner);
    tile.add_polygon({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}}, ground_surface);
    // A grounded roof over all of the cell is no overhang, whoever is below it
    tile.add_polygon({{0, 0, 90}, {20, 0, 90}, {20, 20, 90}, {0, 20, 90}}, 2);
    for (const auto& t : triangles) tile.add_polygon({t[0], t[1], t[2]}, 1);
    const std::filesystem::path path = folder_.path() / "town.farlod";
    FarMapSettings settings;
    settings.horizon.azimuth_bins = 8;
    scenes::pack_tiles(tiles, grid, path, settings, assign, std::vector<Cell>{});
    return PackageReader(path);
  }

  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

}  // namespace farlod
