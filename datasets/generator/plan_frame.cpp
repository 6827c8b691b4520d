// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/plan_frame.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace farlod {
namespace {

/// Taylor series about 0, summed from the smallest term; for |x| ≤ π/4 the first left-out term is below 1e-18.
[[nodiscard]] double sine_of_eighth(double x) {
  double sum = 1.0;
  for (int n = 17; n >= 3; n -= 2) sum = 1.0 - x * x / static_cast<double>(n * (n - 1)) * sum;
  return x * sum;
}

[[nodiscard]] double cosine_of_eighth(double x) {
  double sum = 1.0;
  for (int n = 18; n >= 2; n -= 2) sum = 1.0 - x * x / static_cast<double>(n * (n - 1)) * sum;
  return sum;
}

}  // namespace

std::int64_t millimetres(double value_m) { return std::llround(value_m * 1000.0); }

double on_plan_grid_m(double value_m) { return std::round(value_m * 100.0) / 100.0; }

PlanRotation::PlanRotation(double bearing_deg) {
  // Subtract whole quarter turns, so that 90° is exact
  const double quarters = std::round(bearing_deg / 90.0);
  const double rest_rad = (bearing_deg - 90.0 * quarters) * (std::numbers::pi / 180.0);
  cos_ = cosine_of_eighth(rest_rad);
  sin_ = sine_of_eighth(rest_rad);
  const int turns = ((static_cast<int>(quarters) % 4) + 4) % 4;
  for (int k = 0; k < turns; ++k) cos_ = std::exchange(sin_, cos_) * -1.0;
}

}  // namespace farlod
