// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/expects.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "generator/city_settings.hpp"

namespace farlod {

// The frames of the generator. All are right-handed, z up.
//   plan   metres; origin at the centre of the city, y along the avenues; for the layout of blocks, lots and roofs
//   city   whole millimetres; origin at the centre of the city, x east, y north; for the finished buildings
//   lot    metres; u along the street, v into the lot; see LotFrame

/// A point in whole millimetres. The written coordinates are therefore exact, and equal corners have equal numbers.
using PointMm = Point3<std::int64_t>;

/// The nearest whole millimetre.
[[nodiscard]] std::int64_t millimetres(double value_m);
/// The nearest whole centimetre, in metres. All coordinates of plans are rounded so.
[[nodiscard]] double on_plan_grid_m(double value_m);

/// The rotation of the plan that gives its avenues (y) a bearing, clockwise from grid north. Sine and cosine are computed by
/// additions and multiplications: the results of mathematical libraries may differ in the last bit, and a millimetre could then
/// be rounded differently.
class PlanRotation {
 public:
  explicit PlanRotation(double bearing_deg);

  [[nodiscard]] Point2d city_from_plan(Point2d p_plan) const {
    return {cos_ * p_plan.x + sin_ * p_plan.y, -sin_ * p_plan.x + cos_ * p_plan.y};
  }
  [[nodiscard]] Point2d plan_from_city(Point2d p_city) const {
    return {cos_ * p_city.x - sin_ * p_city.y, sin_ * p_city.x + cos_ * p_city.y};
  }

 private:
  double cos_ = 1.0, sin_ = 0.0;
};

/// The place of a lot in the plan: its corner at the street, and the side of the block that it faces. Side 0 faces south; the
/// others follow counter-clockwise: east, north, west.
struct LotFrame {
  Point2d corner;
  int side = 0;

  /// Rotations are multiples of 90°, so that whole centimetres stay whole.
  [[nodiscard]] Point2d plan_from_lot(Point2d p_lot) const {
    switch (side) {
      case 0:
        return {corner.x + p_lot.x, corner.y + p_lot.y};
      case 1:
        return {corner.x - p_lot.y, corner.y + p_lot.x};
      case 2:
        return {corner.x - p_lot.x, corner.y - p_lot.y};
      default:
        return {corner.x + p_lot.y, corner.y - p_lot.x};
    }
  }
};

/// A block of the city by column (avenues) and row (streets), from the south-west of the plan.
struct CityBlock {
  std::int32_t i = 0, j = 0;
  bool operator==(const CityBlock&) const = default;
};

/// The streets of a city, and the blocks between them. The place of a street is computed without that of the others, so that a
/// city of any size can be made block by block.
///   (1) blocks lie within the square of the city, and do not touch each other
///   (2) between neighboring blocks lies a street at least as wide as asked for
class CityLayout {
 public:
  explicit CityLayout(const CitySettings& settings);

  [[nodiscard]] std::int32_t columns() const { return columns_; }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t block_count() const { return std::int64_t{columns_} * rows_; }
  [[nodiscard]] bool contains(CityBlock block) const {
    return 0 <= block.i && block.i < columns_ && 0 <= block.j && block.j < rows_;
  }
  /// Row by row from the south, each from the west.
  [[nodiscard]] CityBlock block_at(std::int64_t index) const {
    return {static_cast<std::int32_t>(index % columns_), static_cast<std::int32_t>(index / columns_)};
  }
  /// The block's rectangle in the plan: from kerb to kerb.
  [[nodiscard]] Box2d rectangle(CityBlock block) const;

 private:
  enum class Line { avenue, street };
  [[nodiscard]] double axis_m(Line line, std::int32_t number) const;
  [[nodiscard]] double half_width_m(Line line, std::int32_t number) const;

  CitySettings settings_;
  std::int32_t columns_, rows_;
};

/// A side of a block as the frame of its lots: u runs counter-clockwise along the side, v into the block.
[[nodiscard]] LotFrame side_frame(const Box2d& rectangle, int side);
/// Length of that side.
[[nodiscard]] double side_length_m(const Box2d& rectangle, int side);

/// The density of the city and the height of its ground, as smooth functions of the place in the plan.
class UrbanField {
 public:
  explicit UrbanField(const CitySettings& settings);

  /// From 0 (the outermost houses) to 1 (the centre of the core). Falls with the square of the distance from the centre, and
  /// likewise around smaller centres some kilometres apart. Noise makes directions differ.
  [[nodiscard]] double urbanity(Point2d p_plan) const;
  /// The height of the ground, in [0, relief]; on a hillside in [0, 24]. A hillside has slopes of 10 to 25 % along one direction,
  /// which is oblique to the streets, and straight ridges and valleys.
  [[nodiscard]] double ground_m(Point2d p_plan) const;

  /// The core is where the urbanity is at least this.
  static constexpr double core_urbanity = 0.55;

 private:
  [[nodiscard]] double sub_centre_urbanity(Point2d p_plan) const;
  [[nodiscard]] double hillside_m(Point2d p_plan) const;
  [[nodiscard]] double hillside_line_m(std::int64_t number) const;

  std::uint64_t seed_;
  double relief_m_;
  bool hillside_;
  double peak_;           ///< urbanity at the centre; too low in a village for a core
  double core_radius_m_;  ///< where it is half of that
};

/// 0 below `low`, 1 above `high`, smooth between.
[[nodiscard]] double smooth_step(double low, double high, double x);

}  // namespace farlod
