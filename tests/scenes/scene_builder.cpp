// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/scene_builder.hpp"

namespace farlod::scenes {

void SceneBuilder::add_facet(std::vector<Point3d> points, SurfaceKind kind) {
  // city_from_grid turns clockwise: the grid's y axis has the bearing
  for (Point3d& p : points) p = turn_.city_from_grid(p) + shift_;
  city_.begin_facet(kind, next_surface_++);
  city_.add_ring(points);
}

void SceneBuilder::add_wall(Point2d a, Point2d b, double low_m, double high_m) {
  add_polygon({{a.x, a.y, low_m}, {b.x, b.y, low_m}, {b.x, b.y, high_m}, {a.x, a.y, high_m}});
}

void SceneBuilder::add_polygon(const std::vector<Point3d>& points) {
  city_.begin_building("polygon " + std::to_string(city_.buildings().size()));
  next_surface_ = 0;
  add_facet(points, SurfaceKind::unknown);
}

void SceneBuilder::add_prism(const std::vector<Point2d>& outline, double low_m, double high_m) {
  add_frustum(outline, low_m, outline, high_m);
}

void SceneBuilder::add_frustum(const std::vector<Point2d>& foot, double low_m, const std::vector<Point2d>& top, double high_m) {
  city_.begin_building("box " + std::to_string(city_.buildings().size()));
  next_surface_ = 0;
  std::vector<Point3d> roof, floor;
  for (const Point2d p : top) roof.push_back({p.x, p.y, high_m});
  for (const Point2d p : foot) floor.insert(floor.begin(), {p.x, p.y, low_m});
  add_facet(roof, SurfaceKind::roof);
  add_facet(floor, SurfaceKind::floor);
  for (std::size_t n = 0; n < foot.size(); ++n) {
    const std::size_t next = (n + 1) % foot.size();
    const Point2d a = foot[n], b = foot[next], c = top[next], d = top[n];
    add_facet({{a.x, a.y, low_m}, {b.x, b.y, low_m}, {c.x, c.y, high_m}, {d.x, d.y, high_m}}, SurfaceKind::wall);
  }
}

void SceneBuilder::add_box(const Box2d& o, double low_m, double high_m) {
  add_prism({o.low, {o.high.x, o.low.y}, o.high, {o.low.x, o.high.y}}, low_m, high_m);
}

}  // namespace farlod::scenes
