// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_rational.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/grid.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// A double and a bound of how far it is from the exact number that it stands for (running error analysis, Higham 2002, 3.3):
///   (1) |exact − value| ≤ error, where the operands' bounds hold;
///   (2) the bound of an exact double is 0, and sums that are not rounded keep that.
/// Rounding is to nearest. The error of an operation that underflows is infinite.
class BoundedNumber {
 public:
  BoundedNumber() = default;
  BoundedNumber(double exact) : value_(exact) {}

  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] double error() const { return error_; }
  /// Doubles that the exact number lies between.
  [[nodiscard]] double low() const { return value_ - margin(); }
  [[nodiscard]] double high() const { return value_ + margin(); }
  [[nodiscard]] bool is_exact() const { return error_ == 0.0; }

  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    // The rounding error of a sum of two doubles is a double, too (Knuth's TwoSum)
    const double sum = a.value_ + b.value_, of_b = sum - a.value_;
    const double rounding = (a.value_ - (sum - of_b)) + (b.value_ - of_b);
    return {sum, slack * (a.error_ + b.error_ + std::abs(rounding))};
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) {
    return a + BoundedNumber(-b.value_, b.error_);
  }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.is_zero() || b.is_zero()) return {};
    const double product = a.value_ * b.value_;
    const double of_operands = std::abs(a.value_) * b.error_ + std::abs(b.value_) * a.error_ + a.error_ * b.error_;
    return {product, slack * (of_operands + rounding_of(product))};
  }
  /// The error is infinite where `b` may be 0.
  friend BoundedNumber operator/(const BoundedNumber& a, const BoundedNumber& b) {
    if (std::abs(b.value_) <= b.error_) return {0.0, std::numeric_limits<double>::infinity()};
    if (a.is_zero()) return {};
    // With a = A + α and b = B + β: a/b − A/B = (α − β·A/B) / b
    const double quotient = a.value_ / b.value_;
    const double of_operands = (a.error_ + std::abs(quotient) * b.error_) / (std::abs(b.value_) - b.error_);
    return {quotient, slack * (of_operands + rounding_of(quotient))};
  }

 private:
  BoundedNumber(double value, double error) : value_(value), error_(error) {}

  static constexpr double unit_roundoff = 0.5 * std::numeric_limits<double>::epsilon();
  /// A bound is computed in at most 8 operations on numbers that are not negative, each of which may round it down.
  static constexpr double slack = 1.0 + 16.0 * unit_roundoff;

  /// The error, and what the sum of it and the value is rounded by, twice.
  [[nodiscard]] double margin() const { return slack * error_ + 4.0 * unit_roundoff * std::abs(value_); }
  [[nodiscard]] bool is_zero() const { return value_ == 0.0 && error_ == 0.0; }
  static double rounding_of(double result) {
    const double size = std::abs(result);
    return size < std::numeric_limits<double>::min() ? std::numeric_limits<double>::infinity() : unit_roundoff * size;
  }

  double value_ = 0.0, error_ = 0.0;
};

// Private to the wrappers of CGAL and to their tests: the only header of this stage that names its number type.

using Rational = CGAL::Exact_rational;
using ExactPoint = Point3<Rational>;

/// A corner of a piece. Corners that the cut did not make remember which corner of the triangle they are, so that they can be
/// rounded as in a triangle that was never cut.
struct ExactCorner {
  using Number = Rational;
  ExactPoint p_grid;
  std::int8_t original = -1;
};

/// Whatever cells a triangle reaches.
inline constexpr CellRange all_cells{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};

/// A convex part of a triangle, in one cell.
struct ExactPiece {
  Cell cell;
  std::vector<ExactCorner> polygon;
};

/// Cuts a triangle of the grid frame along the borders of the grid, in rational arithmetic:
///   (1) each piece lies in the closed square of its cell
///   (2) the exact area vectors of the pieces sum to the triangle's own: equality, not tolerance
///   (3) a piece on a border belongs to one cell, the one to its east or north
///   (4) two triangles that share an edge are cut at the same points of it
/// Only pieces in the cells `wanted` are returned, and time is spent on no others.
[[nodiscard]] std::vector<ExactPiece> cut_exactly(const std::array<Point3d, 3>& triangle_grid, const Grid& grid,
                                                  const CellRange& wanted = all_cells);

}  // namespace farlod::tiles
