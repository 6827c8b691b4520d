// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/grid.hpp"
#include "farmap/box_map_baker.hpp"
#include "package/package.hpp"
#include "tiles/tiles.hpp"

namespace farlod::scenes {

/// A folder that exists as long as this does.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The grid with this rotation, cell and neighbourhood that covers a city (given in the city frame).
[[nodiscard]] Grid grid_covering(const CityModel& city, Angle bearing, double cell_edge_m, int neighborhood, int block_edge = 32);

/// Packs a city in the city frame through the stages from tiles to package. Far maps are baked for all blocks, or for those
/// of `only` (the others stay empty: for scenes of which one cell is asked).
void pack_city(const CityModel& city, const Grid& grid, const std::filesystem::path& folder, const FarMapSettings& far_map = {},
               Assign assign = Assign::clip, const std::optional<std::vector<Cell>>& only = std::nullopt);

}  // namespace farlod::scenes
