// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "package/package_reader.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "tiles/tiles.hpp"

namespace farlod {

inline void PrintTo(FarMapKind kind, std::ostream* out) { *out << (kind == FarMapKind::box ? "box" : "horizon"); }

}  // namespace farlod

namespace farlod::scenes {

/// The grid with this rotation, cell and neighborhood that covers a city (given in the city frame).
[[nodiscard]] Grid grid_covering(const CityModel& city, Angle bearing, double cell_edge_m, int neighborhood, int block_edge = 32);

/// Far maps of the kind `box`, captured 1.5 m above the ground.
[[nodiscard]] inline FarMapSettings box_maps(std::uint32_t side_columns, std::uint32_t rows) {
  FarMapSettings settings;
  settings.kind = FarMapKind::box;
  settings.box = {side_columns, rows, 1.5};
  return settings;
}
/// Small far maps of either kind, for tests that have to pack much.
[[nodiscard]] inline FarMapSettings small_maps(FarMapKind kind) {
  if (kind == FarMapKind::box) return box_maps(16, 16);
  FarMapSettings settings;
  settings.horizon.azimuth_bins = 64;
  return settings;
}
[[nodiscard]] inline const char* name_of(FarMapKind kind) { return kind == FarMapKind::box ? "Box" : "Horizon"; }

/// The cells whose far maps are wanted, in ascending order; all when absent. The others get maps that hide nothing.
using ChosenCells = std::optional<std::vector<Cell>>;

/// What baking took, and the bytes of blocks that were baked whole (within a block, cells share what they name).
struct FarMapCost {
  double seconds = 0.0;
  std::size_t cells = 0, cells_of_whole_blocks = 0;
  std::uint64_t bytes_of_whole_blocks = 0;
};

/// Packs a city that is cut already.
FarMapCost pack_tiles(const TileSet& tiles, const Grid& grid, const std::filesystem::path& folder, const FarMapSettings& far_map,
                      Assign assign = Assign::clip, const ChosenCells& only = std::nullopt);

/// Packs a city in the city frame through the stages from tiles to package.
void pack_city(const CityModel& city, const Grid& grid, const std::filesystem::path& folder, const FarMapSettings& far_map = {},
               Assign assign = Assign::clip, const ChosenCells& only = std::nullopt);

}  // namespace farlod::scenes
