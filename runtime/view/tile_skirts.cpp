// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_skirts.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace farlod {
namespace {

/// How far a skirt leads outwards and down, as a share of the geometric error of its tile.
constexpr double share_of_error = 0.1;
/// Cosine of the tilt of a facet from which on a skirt would be seen beside it.
constexpr double least_upward = 0.5;
/// Vertices of packages are rounded to less.
constexpr double on_border_m = 0.002;

/// A side of a tile: a line in the grid frame, and the direction away from the tile.
struct TileSide {
  double Point2d::*across;
  double place_m;
  Point2d outward_local;

  [[nodiscard]] bool holds(Point2d p_grid) const { return std::abs(p_grid.*across - place_m) < on_border_m; }
};

/// Those that another tile may adjoin.
std::vector<TileSide> sides_of(const ViewFrame& frame, const TileSquare& square) {
  const double width_m = (frame.cells.i_end - frame.cells.i_begin) * frame.cell_edge_m;
  const double depth_m = (frame.cells.j_end - frame.cells.j_begin) * frame.cell_edge_m;
  const Point2d low = square.low, high = low + Point2d{square.edge_m, square.edge_m};
  std::vector<TileSide> sides;
  if (low.x > on_border_m) sides.push_back({&Point2d::x, low.x, -1.0 * frame.grid_axes.x});
  if (high.x < width_m - on_border_m) sides.push_back({&Point2d::x, high.x, frame.grid_axes.x});
  if (low.y > on_border_m) sides.push_back({&Point2d::y, low.y, -1.0 * frame.grid_axes.y});
  if (high.y < depth_m - on_border_m) sides.push_back({&Point2d::y, high.y, frame.grid_axes.y});
  return sides;
}

bool is_upward(const TileFacet& facet) {
  const auto& [a, b, c] = facet.corners_local;
  // As it is drawn: vertices of simplified tiles have moved
  return normalized(cross(b - a, c - a)).z > least_upward;
}

}  // namespace

void add_skirts(const ViewFrame& frame, const TileTree& tree, const TileAddress& tile, TileSurfaces& surfaces,
                std::vector<float>& values) {
  const double reach_m = share_of_error * tree.geometric_error_m(tile.level);
  const std::vector<TileSide> sides = sides_of(frame, tree.square_of(tile));
  const std::size_t count = surfaces.facets.size();
  for (std::size_t n = 0; n < count; ++n) {
    const TileFacet facet = surfaces.facets[n];
    if (!is_upward(facet)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3d a = facet.corners_local[k], b = facet.corners_local[(k + 1) % 3];
      for (const TileSide& side : sides) {
        if (!side.holds(frame.grid_from_local(horizontal(a))) || !side.holds(frame.grid_from_local(horizontal(b)))) continue;
        const Point3d down{reach_m * side.outward_local.x, reach_m * side.outward_local.y, -reach_m};
        for (const auto& corners : {std::array{a, a + down, b + down}, std::array{a, b + down, b}}) {
          surfaces.facets.push_back({corners, facet.middle_local, facet.normal, facet.feature});
          values.push_back(values[n]);
        }
      }
    }
  }
}

}  // namespace farlod
