// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>

#include "base/grid.hpp"
#include "farlod/pack.hpp"
#include "farmap/bin_borders.hpp"
#include "farmap/city_horizon.hpp"
#include "package/far_map.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// Settings of the kind `box`.
struct BoxMapSettings {
  std::uint32_t side_columns = 64;
  std::uint32_t rows = 64;
  double capture_height_m = 1.5;  ///< above the ground at the cell's centre, where most receivers will stand
};

/// Settings of the kind `horizon`.
struct HorizonMapSettings {
  std::uint32_t azimuth_bins = 256;
  std::uint32_t squares_per_edge = 1;  ///< 1 to 4
  std::uint32_t layers = 8;            ///< 2 to package::most_layers
  /// An occluder is explicit where it may rise by more than this (sine of the elevation) over what hides the sky anyway.
  double tolerance = 0.05;
  /// A hidden occluder is weak, and counts for the estimate, where it may rise by more than this share of the tolerance.
  double weak_share = 0.6;
  /// The same two of the far terrain beyond the grid, both as sines: its ridges are long, so that what is wrong with the one half
  /// of a ridge is wrong with the other.
  double far_terrain_tolerance = 0.01, weak_far_terrain = 0.002;
};

struct FarMapSettings {
  FarMapKind kind = FarMapKind::horizon;
  BoxMapSettings box;
  HorizonMapSettings horizon;
};

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
