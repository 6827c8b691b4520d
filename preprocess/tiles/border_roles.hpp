// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "tiles/building_pieces.hpp"
#include "tiles/contacts.hpp"
#include "tiles/ground.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::tiles {

/// An upper border of a building that has open lower borders.
struct UpperBorder {
  HorizonSegment segment;  ///< with its role
  /// It is grounded by the wall below it alone: the roof behind it may be open below, so that it faces all eyes.
  bool by_wall = false;
};

/// The borders of such a building. Left out are those that no eye outside of its solids sees as a silhouette: inside of them, or
/// right below a grounded border. Proof in docs/concepts.md, "What is grounded, and what overhangs".
struct BordersWithRoles {
  std::vector<UpperBorder> upper;
  std::vector<HorizonSegment> undersides;
  /// Lower borders where walls that lean by some millimetres end at a corner. What touches them tells nothing.
  std::vector<HorizonSegment> corners;
  std::vector<ClosingTriangle> closing;  ///< what closes the air below such corners of grounded borders
};
/// `undersides`: those of the building that are above the ground. It loses its walls, slabs and corners.
[[nodiscard]] BordersWithRoles borders_with_roles(BuildingPieces& building, const std::vector<HorizonSegment>& undersides,
                                                  const GroundHeightAt& ground_height);

/// The numbers of the upright surfaces of a building, sorted.
struct NumbersOfWalls {
  std::vector<std::uint32_t> all;
  /// All their edges lie on borders of walls, or right below these, which face all eyes if the building has lower borders.
  std::vector<std::uint32_t> hidden;
};
[[nodiscard]] NumbersOfWalls walls_of(const CityModel& city_grid, const Building& building,
                                      const std::vector<UpperBorder>& borders);

/// A building with lower borders that none of its own facets closes.
struct OverhangingBuilding {
  std::vector<UpperBorder> upper_borders;
  std::vector<CellEdge> undersides, corners;
  std::vector<ClosingTriangle> closing;  ///< cracks where it touches others
  std::optional<std::uint32_t> closing_surface;
  std::optional<Cell> only_cell;
  std::uint32_t first_surface = 0, end_surface = 0;  ///< in TileSet::surfaces
  NumbersOfWalls walls;
};

/// All surfaces of a building that overhangs do, but for these walls. Roofs that hide nothing either may be overhead.
void tell_what_overhangs(std::span<Surface> surfaces, const std::vector<std::uint32_t>& walls);

/// Adds the ends of closed cracks, which span them: sections may rise over one of these between the surfaces on either side.
void add_ends(const std::vector<ClosingTriangle>& closing, std::vector<UpperBorder>& borders);

/// What is placed of the upper borders: where `has_undersides`, with their roles; else all of them are grounded.
[[nodiscard]] std::vector<HorizonSegment> placed_borders(const std::vector<UpperBorder>& borders, bool has_undersides);

}  // namespace farlod::tiles
