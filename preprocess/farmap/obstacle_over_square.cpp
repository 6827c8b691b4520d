// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "farmap/obstacle_over_square.hpp"

#include "farlod/horizon/edge_view.hpp"

namespace farlod {
namespace {

/// Whether a triangle covers a point of the plane; not so when the point is on its outline.
bool covers(const std::array<Point3d, 3>& triangle, Point2d p) {
  int left = 0, right = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3d eye{p.x, p.y, 0.0};
    const double turn = EdgeView{triangle[n] - eye, triangle[(n + 1) % 3] - eye}.turn();
    left += turn > 0.0 ? 1 : 0;
    right += turn < 0.0 ? 1 : 0;
  }
  return left == 3 || right == 3;
}

}  // namespace

void ObstacleOverSquare::look_at(const Obstacle& obstacle, Point2d origin, const Box2d& square) {
  const std::array<Point3d, 3> p = obstacle.corners_from(origin);
  edge_count_ = obstacle.edge_count();
  // No edge may come near a square that a triangle hangs over: then its middle tells
  surrounds_ = !obstacle.is_edge && covers(p, 0.5 * (square.low + square.high));
  for (std::size_t n = 0; n < edge_count_ && !surrounds_; ++n) {
    edges_[n].look_at(p[n], p[(n + 1) % 3], square);
    surrounds_ = edges_[n].surrounds();
  }
}

}  // namespace farlod
