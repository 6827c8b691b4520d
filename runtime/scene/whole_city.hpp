// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "base/grid.hpp"
#include "occlusion/occluder.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// All tiles of a package as one scene: the reference that needs no far map. Its frame is the grid frame moved to the corner
/// of the middle cell, with heights as on disk. Costs memory in proportion to the city.
class WholeCity {
 public:
  /// Throws Cancelled when `stop` is asked for meanwhile.
  explicit WholeCity(const PackageReader& package, const std::stop_token& stop = {});

  [[nodiscard]] const Occluder& occluder() const { return occluder_; }
  /// Added to a place of the frame of `cell`, gives one of this scene.
  [[nodiscard]] Point2d scene_from_cell_m(Cell cell) const { return grid_.corner_of(cell) - origin_grid_; }
  /// A point of the frame of `cell` in the frame of this scene.
  [[nodiscard]] Point3f scene_from_cell(const Point3f& p_cell, Cell cell) const;

 private:
  const Grid& grid_;
  Point2d origin_grid_;
  Occluder occluder_;
};

}  // namespace farlod
