// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "package/tile_set.hpp"
#include "tiles/contacts.hpp"
#include "tiles/cutting.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/leaning_corners.hpp"
#include "tiles/slab.hpp"
#include "tiles/tiles.hpp"
#include "tiles/undersides.hpp"

namespace farlod::tiles {

/// The area vector of a facet, and one of its points.
struct OrientedArea {
  Point3d area_vector_m2;
  Point3d point;
  std::uint16_t part = 0;
};

/// For each facet of a building, +1 when it was drawn with its normal outward and −1 otherwise.
/// Files do not agree on which way facets face, but within a closed part they mostly agree with each other: the sign of
/// the part's volume, taken about its middle so that a missing facet changes little, decides for all of them.
[[nodiscard]] std::vector<double> outward_signs(std::span<const OrientedArea> facets);

/// A surface of one building, whole.
struct BuildingSurface {
  Surface surface;  ///< its building is not filled in
  Point3d middle;   ///< area-weighted, grid frame
};

struct SurfacePiece {
  CellPiece piece;
  std::uint32_t surface = 0;  ///< place in BuildingPieces::surfaces
};

/// One building, triangulated and cut. Depends only on the building, the grid and the settings.
struct BuildingPieces {
  std::vector<BuildingSurface> surfaces;
  std::vector<SurfacePiece> pieces;
  std::vector<CellEdge> upper_pieces;         ///< of the edges that can be a horizon, grounded
  std::vector<HorizonSegment> upper_borders;  ///< these edges, if the building has undersides; grid frame
  std::vector<HorizonSegment> undersides;     ///< including those on the ground; grid frame
  /// The walls of a building with undersides above its lowest floor. Few others need them: there, wall_profiles gives them.
  std::optional<std::vector<WallProfile>> walls;
  std::vector<Slab> slabs;             ///< of such a building
  std::vector<Segment3d> loose_edges;  ///< its edges of an odd number of triangles: where it is not closed
  std::vector<LeaningCorner> corners;
  Places grounded_ends{
      &comes_first};  ///< of its upper borders, if it has corners: all are grounded, if no underside is above the ground
  std::vector<ClosingTriangle> closing;  ///< close cracks between its facets; grid frame
  std::optional<Cell> only_cell;         ///< the cell of the whole building when it is not cut
  std::vector<Problem> problems;         ///< without the source, which a building alone does not know; grid frame
};

/// The largest number of a part of the building.
[[nodiscard]] std::uint16_t last_part(const BuildingPieces& pieces);

/// Triangulates and cuts one building, given in the grid frame.
[[nodiscard]] BuildingPieces cut_building(const CityModel& city_grid, const Building& building, const Grid& grid, Assign assign,
                                          double height_origin_m);

/// The profiles of a building's facets that are walls.
[[nodiscard]] std::vector<WallProfile> wall_profiles(const CityModel& city_grid, const Building& building);

}  // namespace farlod::tiles
