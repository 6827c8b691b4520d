// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <stop_token>

#include "base/grid.hpp"
#include "farmap/far_map_settings.hpp"
#include "package/baked_block.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"
#include "tiles/tiles.hpp"

namespace farlod {

class BoxMapBaker;
class CityHorizon;
class HorizonMapBaker;

/// Bakes far maps of the kind that the settings ask for.
class FarMapBaker {
 public:
  /// The tiles and the grid must outlive the baker.
  FarMapBaker(const TileSet& tiles, const Grid& grid, Assign assign, const FarMapSettings& settings);
  /// Bakes far maps of the kind `horizon`, of the occluders of these tiles.
  FarMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings, CityHorizon city);
  FarMapBaker(FarMapBaker&&) noexcept;
  ~FarMapBaker();

  /// The occluders of far maps of the kind `horizon`; null for the kind `box`.
  [[nodiscard]] const CityHorizon* horizon() const;

  /// In the order of CellRange::index_of. The same for any number of threads. Throws Cancelled when `stop` is asked for.
  [[nodiscard]] BakedBlock bake(Block block, const std::stop_token& stop = {}) const;
  /// The far maps of some cells of the block, at least one, in their order.
  [[nodiscard]] BakedBlock bake(Block block, const package::CellRuns& cells, const std::stop_token& stop = {}) const;

 private:
  const Grid& grid_;
  std::unique_ptr<BoxMapBaker> box_;
  std::unique_ptr<HorizonMapBaker> horizon_;
};

/// What the manifest says of far maps with these settings.
[[nodiscard]] package::FarMapShape shape_of(const FarMapSettings& settings);

}  // namespace farlod
