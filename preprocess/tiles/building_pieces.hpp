// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/grid.hpp"
#include "farlod/problem.hpp"
#include "tiles/cutting.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/tile_set.hpp"
#include "tiles/tiles.hpp"

namespace farlod {

/// A surface of one building, whole.
struct BuildingSurface {
  Surface surface;  ///< its building is not filled in
  Point3d middle;   ///< area-weighted, grid frame
};

struct SurfacePiece {
  CellPiece piece;
  std::uint32_t surface = 0;  ///< place in BuildingPieces::surfaces
};

/// What one building comes to. Depends on nothing but the building, the grid and the settings.
struct BuildingPieces {
  std::vector<BuildingSurface> surfaces;
  std::vector<SurfacePiece> pieces;
  std::vector<CellEdge> horizon_edges;  ///< if it stands
  std::vector<Point3d> open_ends;       ///< where it is open: it stands only if these are at the ground; grid frame
  std::vector<Problem> problems;        ///< without the source, which a building alone does not know; grid frame
};

/// Triangulates and cuts one building, given in the grid frame.
[[nodiscard]] BuildingPieces cut_building(const CityModel& city_grid, const Building& building, const Grid& grid, Assign assign,
                                          double height_origin_m);

}  // namespace farlod
