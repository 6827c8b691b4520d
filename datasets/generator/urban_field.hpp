// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/point.hpp"
#include "generator/city_settings.hpp"

namespace farlod {

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
