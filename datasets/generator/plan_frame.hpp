// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "farlod/point.hpp"

namespace farlod {

// The frames of the generator. All are right-handed, z up.
//   plan   metres; origin at the city's centre, y along the avenues; where blocks, lots and roofs are laid out
//   city   whole millimetres; origin at the city's centre, x east, y north; where buildings are handed out
//   lot    metres; u along the street, v into the lot; see LotFrame

/// A point in whole millimetres: what is written is exactly what was made, and equal corners are equal numbers.
using PointMm = Point3<std::int64_t>;

/// The nearest whole millimetre.
[[nodiscard]] std::int64_t millimetres(double value_m);
/// The nearest whole centimetre, still in metres: plans are drawn on this grid.
[[nodiscard]] double on_plan_grid_m(double value_m);

/// Turns the plan so that its avenues (y) have the given bearing, clockwise from grid north.
/// Sine and cosine are computed here from additions and multiplications only: the mathematics libraries of two systems may
/// differ in the last bit, and a millimetre could then round differently.
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

/// Where a lot lies in the plan: its corner on the street, and which of the block's sides it faces.
/// Side 0 faces south, then counter-clockwise: east, north, west.
struct LotFrame {
  Point2d corner;
  int side = 0;

  /// Turns by whole quarters, so that centimetres stay centimetres.
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

}  // namespace farlod
