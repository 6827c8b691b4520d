// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <stop_token>

#include "base/grid.hpp"
#include "farmap/bin_borders.hpp"
#include "farmap/city_horizon.hpp"
#include "farmap/far_map_settings.hpp"
#include "package/baked_block.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// Bakes far maps without parallax: occluders that shift against the horizon behind them within a patch are explicit, so that the
/// runtime draws them from where each receiver stands; the residual city is bounded. docs/stages/farmap.md.
class HorizonMapBaker {
 public:
  /// The tiles and the grid must outlive the baker.
  HorizonMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings);
  /// `city` is that of these tiles.
  HorizonMapBaker(const TileSet& tiles, const Grid& grid, const HorizonMapSettings& settings, CityHorizon city);

  [[nodiscard]] const CityHorizon& city() const { return city_; }

  [[nodiscard]] BakedHorizons bake(Block block, const std::stop_token& stop = {}) const;
  /// The far maps of these cells, at least one. The explicit occluders are in the frame of the first.
  [[nodiscard]] BakedHorizons bake(std::span<const Cell> cells, const std::stop_token& stop = {}) const;
  /// The same in the frame of another cell.
  [[nodiscard]] BakedHorizons bake(std::span<const Cell> cells, Cell frame, const std::stop_token& stop = {}) const;

 private:
  [[nodiscard]] BakedHorizon bake_cell(Cell cell) const;

  const TileSet& tiles_;
  const Grid& grid_;
  HorizonMapSettings settings_;
  CityHorizon city_;
  BinBorders borders_;
};

}  // namespace farlod
