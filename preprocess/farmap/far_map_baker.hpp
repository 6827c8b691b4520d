// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "base/grid.hpp"
#include "farlod/box.hpp"
#include "farmap/horizon_map_baker.hpp"
#include "occlusion/occluder.hpp"
#include "package/far_map.hpp"
#include "package/manifest.hpp"
#include "package/tile_set.hpp"
#include "tiles/tiles.hpp"

namespace farlod {

/// Bounds how high the far city can rise above the horizontal, so that a far map spends its rows on what is there.
class FarHeightBound {
 public:
  FarHeightBound(const TileSet& tiles, const Grid& grid);

  /// An upper bound of height over horizontal distance (the longer of |x| and |y|, as in BoxMap::top) over all that lies
  /// outside of the neighborhood of `cell`, seen from its centre at `capture_height_m`; 0 when nothing rises above it.
  [[nodiscard]] float top(Cell cell, float capture_height_m) const;

 private:
  struct Prism {
    Box2d outline_grid;
    float height_m;
  };
  struct BlockPrism {
    Prism prism;
    CellRange cells;
  };
  void add_far_terrain(const FarTerrain& far_terrain);
  [[nodiscard]] static double slope(const Prism& prism, Point2d centre_grid, float capture_height_m);

  const Grid& grid_;
  CellRange cells_;
  std::vector<Prism> tiles_, far_terrain_;
  std::vector<BlockPrism> blocks_;
};

/// All tiles and the far terrain as one occluder. Its frame is the grid frame, moved to the corner of the middle cell so that
/// floats are finest in the city, with heights as in the tiles.
class CityOccluder {
 public:
  CityOccluder(const TileSet& tiles, const Grid& grid);

  [[nodiscard]] const Occluder& occluder() const { return occluder_; }
  [[nodiscard]] Point3f frame_from_grid(Point2d p_grid, float height_m) const {
    return {static_cast<float>(p_grid.x - origin_grid_.x), static_cast<float>(p_grid.y - origin_grid_.y), height_m};
  }
  /// The cell whose tile holds a triangle of the occluder; beyond_grid for the far terrain.
  [[nodiscard]] Cell cell_of_triangle(std::uint32_t triangle) const;

 private:
  CellRange cells_;
  Point2d origin_grid_;
  std::vector<std::uint32_t> first_triangle_;  ///< of each tile, and of the far terrain
  Occluder occluder_;
};

/// Captures the far maps of a block's cells, in the order of CellRange::index_of: what the city outside of each cell's
/// neighborhood hides, one ray a texel from the cell's centre (paper, Section 3; on a box that has no lid instead of a cube).
class BoxMapBaker {
 public:
  /// The tiles and the grid must outlive the baker.
  BoxMapBaker(const TileSet& tiles, const Grid& grid, Assign assign, const BoxMapSettings& settings)
      : tiles_(tiles), grid_(grid), assign_(assign), settings_(settings), city_(tiles, grid), height_bound_(tiles, grid) {}

  [[nodiscard]] BakedBoxes bake(Block block, const std::stop_token& stop = {}) const;
  /// The far maps of these cells, in their order.
  [[nodiscard]] BakedBoxes bake(std::span<const Cell> cells, const std::stop_token& stop = {}) const;

 private:
  [[nodiscard]] BakedBox bake_cell(Cell cell) const;
  [[nodiscard]] float distance_m(const Point3f& capture, const Point3d& direction, const CellRange& near) const;

  const TileSet& tiles_;
  const Grid& grid_;
  Assign assign_;
  BoxMapSettings settings_;
  CityOccluder city_;
  FarHeightBound height_bound_;
};

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
