// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "farlod/point.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod::analytic {

inline constexpr double eye_m = 1.5;      // receivers stand this high, as the far maps are captured
inline constexpr double ground = -eye_m;  // scenes are drawn around the eye

/// What walls are made of: sheets from the ground up, or houses.
enum class Walls { sheets, houses };

/// Where a scene is set up.
class Stage {
 public:
  Stage(scenes::SceneBuilder& builder, Walls walls) : builder_(builder), walls_(walls) {}

  /// A wall from the ground up. A house behind it shows the eye nothing but the wall: its sides are in line with the eye.
  void add_wall(Point2d a, Point2d b, double high_m);
  void add_polygon(const std::vector<Point3d>& points) { builder_.add_polygon(points); }

 private:
  scenes::SceneBuilder& builder_;
  Walls walls_;
};

/// A scene with a known answer.
struct Scene {
  std::string name;
  std::function<void(Stage&)> build;
  double svf_cos, svf_solid;     // NaN: no closed form
  double nearest_m, farthest_m;  // how near and how far its geometry is
  double rise;                   // total variation of tan β along the circle
  double extra_error = 0.0;      // of the scene itself, where it stands in for a smooth one
  Point3d normal{0.0, 0.0, 1.0};
  bool is_overhead = false;  ///< the part right above the cell is near in any case
};
void PrintTo(const Scene& scene, std::ostream* out);

[[nodiscard]] std::vector<Scene> all_scenes();

}  // namespace farlod::analytic
