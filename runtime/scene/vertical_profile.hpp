// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contract/grid.hpp"
#include "contract/package/layout.hpp"
#include "package/package_reader.hpp"
#include "scene/plan_index.hpp"

namespace farlod {

/// The surfaces above and below one point of the plan, from low to high. Heights are those of the package.
class VerticalProfile {
 public:
  struct Crossing {
    float height_m;
    std::uint32_t building;  ///< number within the city; package::no_building for the ground
    std::uint16_t part;      ///< closed part of the building
    bool looks_up;           ///< its outward normal does
  };
  explicit VerticalProfile(std::vector<Crossing> crossings) : crossings_(std::move(crossings)) {}

  /// The height of the highest ground; none where the package has no ground.
  [[nodiscard]] std::optional<float> ground_m() const;
  /// The height of the highest surface: a roof, a bridge, or the ground.
  [[nodiscard]] std::optional<float> highest_m() const;
  /// Whether a point at this height lies inside a part of a building: above the point, more surfaces of the part look up than
  /// down. Under a bridge or an arcade there are as many of both; a part without a roof encloses nothing. (Counting odd and even
  /// would fail where a main roof continues below a rooftop structure.)
  [[nodiscard]] bool is_inside_building(float height_m) const;
  /// Whether a receiver at this height has no data: it lies inside a building, below the ground, or between the ground and a
  /// floor that stands on it.
  [[nodiscard]] bool is_buried(float height_m) const;

 private:
  [[nodiscard]] bool is_below_standing_floor(float height_m, float ground_m) const;

  std::vector<Crossing> crossings_;
};

/// Makes the vertical profiles of points in one cell.
class PointLocator {
 public:
  /// Reads the cell's own tile, which holds everything in the cell when buildings are cut at the borders. Where buildings were
  /// assigned whole, the tiles within `reach_of_whole_buildings` cells are read, too.
  PointLocator(const PackageReader& package, Cell cell);

  [[nodiscard]] VerticalProfile at(float x_cell, float y_cell) const;

  static constexpr std::int32_t reach_of_whole_buildings = 2;

 private:
  std::vector<TileView> tiles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places_;  ///< of each triangle: its tile, and its number there
  PlanIndex index_;
};

}  // namespace farlod
