// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/grid.hpp"
#include "package/layout.hpp"
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
  VerticalProfile() = default;
  /// From low to high.
  explicit VerticalProfile(std::vector<Crossing> crossings) : crossings_(std::move(crossings)) {}

  void clear() { crossings_.clear(); }
  /// Adds a crossing in its place, after those of the same height.
  void add(const Crossing& crossing);

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

/// The triangles above and below the places of a cell, in the frame of the cell. Upright ones, which are above and below no
/// place, are left out.
class TrianglesOfCell {
 public:
  /// Reads the cell's own tile, which holds everything in the cell when buildings are cut at the borders. Where buildings were
  /// assigned whole, the tiles within `reach_of_whole_buildings` cells are read, too.
  TrianglesOfCell(const PackageReader& package, Cell cell);

  [[nodiscard]] const std::vector<PlanTriangle>& corners() const { return corners_; }
  /// The profile of a place from its crossings with the triangles.
  void make_profile(std::span<const PlanCrossing> crossings, VerticalProfile& profile) const;

  static constexpr std::int32_t reach_of_whole_buildings = 2;

 private:
  /// What a crossing says of its triangle.
  struct Surface {
    std::uint32_t building;
    std::uint16_t part;
    bool looks_up;
  };
  void add(const TileView& tile, Point2d shift_m);

  std::vector<PlanTriangle> corners_;
  std::vector<Surface> surfaces_;  ///< of each triangle
};

/// Makes the vertical profiles of single places in one cell.
class PointLocator {
 public:
  PointLocator(const PackageReader& package, Cell cell) : triangles_(package, cell), index_(triangles_.corners()) {}

  [[nodiscard]] VerticalProfile at(float x_cell, float y_cell) const;

 private:
  TrianglesOfCell triangles_;
  PlanIndex index_;
};

/// Makes the vertical profiles of the places of lattices in one cell: what PointLocator says of each of them, in a fraction of
/// the time.
class LatticeLocator {
 public:
  LatticeLocator(const PackageReader& package, Cell cell) : triangles_(package, cell) {}

  /// Looks at all places of a lattice. Its places are in the frame of the cell.
  void look_at(const PlanLattice& lattice) { crossings_.find(triangles_.corners(), lattice); }
  /// The profile of the n-th place of the lattice that was looked at last. It is valid until the next question.
  [[nodiscard]] const VerticalProfile& at(std::size_t n);

 private:
  TrianglesOfCell triangles_;
  LatticeCrossings crossings_;
  VerticalProfile profile_;
};

}  // namespace farlod
