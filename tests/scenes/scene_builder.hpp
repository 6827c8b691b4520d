// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/frame.hpp"
#include "city/city_model.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"

namespace farlod::scenes {

/// Builds a city from simple bodies. Each becomes a building of its own.
class SceneBuilder {
 public:
  /// Everything added afterwards is moved by `shift` and turned by `turn` (clockwise) about it.
  explicit SceneBuilder(const Point3d& shift = {}, Angle turn = {}) : shift_(shift), turn_(turn) {}

  /// A vertical wall without thickness between two places.
  void add_wall(Point2d a, Point2d b, double low_m, double high_m);
  /// A single polygon.
  void add_polygon(const std::vector<Point3d>& points);
  /// A closed body with a flat roof over a counter-clockwise outline.
  void add_prism(const std::vector<Point2d>& outline, double low_m, double high_m);
  /// A closed body between two levels, with outlines of as many points; each wall is one facet.
  void add_frustum(const std::vector<Point2d>& foot, double low_m, const std::vector<Point2d>& top, double high_m);
  /// A closed box.
  void add_box(const Box2d& outline, double low_m, double high_m);

  [[nodiscard]] const CityModel& city() const { return city_; }

 private:
  void add_facet(std::vector<Point3d> points, SurfaceKind kind);
  CityModel city_;
  Point3d shift_;
  GridRotation turn_;
  std::uint32_t next_surface_ = 0;
};

}  // namespace farlod::scenes
