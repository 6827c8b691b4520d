// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "farlod/surface_kind.hpp"
#include "view/tile_tree.hpp"

namespace farlod {

/// A surface of a building, or the ground.
struct TileFeature {
  std::string building;       ///< empty of the ground
  std::uint32_t surface = 0;  ///< its number within the building, as SurfaceMean has it; 0 of the ground
  SurfaceKind kind = SurfaceKind::unknown;
};

/// A triangle that is drawn in one colour.
struct TileFacet {
  std::array<Point3d, 3> corners_local;  ///< as it is drawn
  /// Where its value is computed: in the middle of the triangle that it stands for.
  Point3d middle_local;
  Point3d normal;             ///< outward, of length 1
  std::uint32_t feature = 0;  ///< its number in TileSurfaces::features
};

struct TileSurfaces {
  std::vector<TileFacet> facets;
  std::vector<TileFeature> features;
};

/// What is drawn of a tile that has content. Tiles that are cells, or parts of one, have the geometry as it is, divided until no
/// edge is longer than two geometric errors. Larger tiles have their vertices moved into clusters (Rossignac & Borrel 1993), none
/// by more than the geometric error; those on the border of a tile stay on it, and triangles that vanish are left out.
/// Throws PackageUnusable, PackageDamaged.
[[nodiscard]] TileSurfaces surfaces_of(const Package& package, const ViewFrame& frame, const TileTree& tree,
                                       const TileAddress& tile);

}  // namespace farlod
