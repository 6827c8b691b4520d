// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/plane_curve.hpp"

#include <algorithm>
#include <utility>

namespace farlod::benchmark {
namespace {

constexpr std::uint32_t squares_per_edge = 1U << 16;

std::uint32_t square_along(double x) {
  return static_cast<std::uint32_t>(std::clamp(x * squares_per_edge, 0.0, squares_per_edge - 1.0));
}

}  // namespace

std::uint64_t place_on_curve(double x, double y) {
  std::uint32_t column = square_along(x), row = square_along(y);
  std::uint64_t place = 0;
  for (std::uint32_t edge = squares_per_edge / 2; edge > 0; edge /= 2) {
    const std::uint32_t right = (column & edge) != 0 ? 1 : 0, upper = (row & edge) != 0 ? 1 : 0;
    place += std::uint64_t{edge} * edge * ((3 * right) ^ upper);
    // Turn the quarter so that the curve through it begins where the one before ended
    if (upper == 0) {
      if (right == 1) {
        column = squares_per_edge - 1 - column;
        row = squares_per_edge - 1 - row;
      }
      std::swap(column, row);
    }
  }
  return place;
}

}  // namespace farlod::benchmark
