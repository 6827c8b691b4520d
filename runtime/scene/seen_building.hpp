// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// Directions between two azimuths and two elevations of a scene.
struct DirectionWindow {
  double from_rad = 0.0, width_rad = 0.0;  ///< the first azimuth, clockwise from the y axis, and the turn from there
  double low_z = 0.0, high_z = 0.0;        ///< sines of the elevations

  [[nodiscard]] double solid_angle() const { return width_rad * (high_z - low_z); }
  /// The direction at a place of the unit square: equal parts of the square are equal solid angles of the window.
  [[nodiscard]] Point3d direction(Point2d p_square) const;
};

/// A building of the scene of the whole city (WholeCity): all that have its id, where several share it. Immutable.
class SeenBuilding {
 public:
  /// Throws as require_building, and Cancelled when `stop` is asked for meanwhile.
  SeenBuilding(const PackageReader& package, const std::string& id, const std::stop_token& stop = {});

  /// Whether a triangle of the scene is one of the building's. Those of the far terrain are beyond all that are known.
  [[nodiscard]] bool has(std::uint32_t triangle) const { return triangle < is_own_.size() && is_own_[triangle]; }
  /// Directions among which all are in which a place of the scene can see the building: those of its box.
  [[nodiscard]] DirectionWindow window_from(const Point3f& place) const;

 private:
  void add(const TileView& tile, Point2d corner_m, std::span<const std::uint32_t> numbers);

  std::vector<bool> is_own_;
  Box2d outline_;  ///< in the plan of the scene
  float low_m_ = std::numeric_limits<float>::infinity(), high_m_ = -std::numeric_limits<float>::infinity();
};

/// Throws InvalidArgument, which names the nearest id, where no building of the package has this one.
void require_building(const PackageReader& package, const std::string& id);

}  // namespace farlod
