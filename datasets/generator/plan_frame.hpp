// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "farlod/point.hpp"

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

}  // namespace farlod
