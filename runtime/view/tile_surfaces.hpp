// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
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

/// A point of a lattice, which all vertices near it move to.
struct ClusterPlace {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const ClusterPlace&) const = default;
};

/// In the plan, vertices go to the nearest point of a lattice that divides the square's edges evenly; in height, to the mean of
/// those that have the same nearest level. With a step s they move by s/√2 in the plan, and by s in height at the most: √1.5 s.
class ClusterLattice {
 public:
  ClusterLattice(const ViewFrame& frame, const TileSquare& square, double error_m);

  [[nodiscard]] ClusterPlace place_of(const Point3d& p_local) const;
  [[nodiscard]] Point2d point_local(const ClusterPlace& place) const;

 private:
  const ViewFrame& frame_;
  TileSquare square_;
  double step_m_;
};

/// Simplifies what is drawn of a tile: vertices near each other become one, and facets that are a line or a point then are left
/// out. Of facets that then cover one another, the one that looks up the most stays. Ground and buildings do not share vertices.
///   (1) no vertex moves by more than `error_m`
///   (2) one on the border of the square stays on it, and moves as the neighboring tile's does, but for its height
void move_into_clusters(const ViewFrame& frame, const TileSquare& square, double error_m, TileSurfaces& surfaces);

/// Azimuths of the values that colours show: of tiles of one cell or less, and of larger ones, whose facets stand for more than
/// themselves. Of the places that are asked for one by one, it is default_azimuths.
inline constexpr std::size_t azimuths_of_cells = 96, azimuths_of_larger_tiles = 32;

/// How far in front of its surface a receiver stands.
inline constexpr double receiver_offset_m = 0.01;

/// The sky view factor of each facet: of ground 1.5 m above it, looking up; of others on the surface, along its normal. NaN where
/// there is none. A facet whose middle lies in a building, or in the gap between two, has the mean of what is free of it.
/// Throws PackageUnusable, PackageDamaged.
[[nodiscard]] std::vector<float> values_of(const Package& package, const ViewFrame& frame, const TileSurfaces& surfaces,
                                           std::size_t azimuths);

}  // namespace farlod
