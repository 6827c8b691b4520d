// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_skirts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace farlod {
namespace {

/// 2 × 2 cells of 100 m, turned.
ViewFrame frame_of_four_cells() {
  ViewFrame frame;
  frame.grid_axes = GridAxes::turned_by(Angle::degrees(20.0));
  frame.cell_edge_m = 100.0;
  frame.cells = {0, 0, 2, 2};
  frame.corner_local = {-30.0, 15.0};
  return frame;
}

/// A level square of ground over the whole of a square, as two facets.
TileSurfaces ground_over(const ViewFrame& frame, const TileSquare& square) {
  const auto at = [&](double x, double y) {
    const Point2d p = frame.local_from_grid(square.low + square.edge_m * Point2d{x, y});
    return Point3d{p.x, p.y, 7.0};
  };
  TileSurfaces surfaces{{}, {{"", 0, SurfaceKind::ground}}};
  surfaces.facets.push_back({{at(0, 0), at(1, 0), at(1, 1)}, at(0.7, 0.3), {0.0, 0.0, 1.0}, 0});
  surfaces.facets.push_back({{at(0, 0), at(1, 1), at(0, 1)}, at(0.3, 0.7), {0.0, 0.0, 1.0}, 0});
  return surfaces;
}

class TileSkirts : public testing::Test {
 protected:
  ViewFrame frame = frame_of_four_cells();
  TileTree tree{frame};
  TileAddress south_west{tree.level_of_cells(), 0, 0};
  TileSurfaces surfaces = ground_over(frame, tree.square_of(south_west));
  std::vector<float> values{0.25F, 0.5F};
};

TEST_F(TileSkirts, GoOnBelowTheNeighborsAlone) {
  const TileSurfaces before = surfaces;
  add_skirts(frame, tree, south_west, surfaces, values);
  ASSERT_EQ(surfaces.facets.size(), 6U) << "two facets for the eastern side, two for the northern one";
  ASSERT_EQ(values.size(), 6U);
  for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(surfaces.facets[n].corners_local, before.facets[n].corners_local);
  EXPECT_EQ(values, (std::vector{0.25F, 0.5F, 0.25F, 0.25F, 0.5F, 0.5F}));
  const double reach_m = 0.1 * tree.geometric_error_m(south_west.level);
  for (std::size_t n = 2; n < 6; ++n) {
    const auto& [a, b, c] = surfaces.facets[n].corners_local;
    EXPECT_NEAR(normalized(cross(b - a, c - a)).z, std::sqrt(0.5), 1e-9) << "it looks up, as the ground does";
    double farthest_m = 0.0;
    for (const Point3d& p : {a, b, c}) {
      const Point2d beyond = frame.grid_from_local(horizontal(p)) - Point2d{100.0, 100.0};
      const double out_m = std::max(beyond.x, beyond.y);
      EXPECT_NEAR(p.z, 7.0 - out_m, 1e-9) << "it begins at the border, and falls by as much as it leads out";
      farthest_m = std::max(farthest_m, out_m);
    }
    EXPECT_NEAR(farthest_m, reach_m, 1e-9);
  }
}

TEST_F(TileSkirts, WallsHaveNone) {
  const Point2d low = frame.local_from_grid({100.0, 10.0}), high = frame.local_from_grid({100.0, 40.0});
  surfaces.facets = {{{{{low.x, low.y, 0.0}, {high.x, high.y, 0.0}, {high.x, high.y, 9.0}}}, {}, {1.0, 0.0, 0.0}, 0}};
  values = {0.5F};
  add_skirts(frame, tree, south_west, surfaces, values);
  EXPECT_EQ(surfaces.facets.size(), 1U);
}

TEST_F(TileSkirts, OneTileOfAWholeCityHasNone) {
  surfaces = ground_over(frame, tree.square_of({}));
  add_skirts(frame, tree, {}, surfaces, values);
  EXPECT_EQ(surfaces.facets.size(), 2U);
}

}  // namespace
}  // namespace farlod
