// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <compare>
#include <numbers>

namespace farlod {

/// An angle that cannot be mistaken for a number of radians or degrees.
class Angle {
 public:
  constexpr Angle() = default;
  [[nodiscard]] static constexpr Angle radians(double value) { return Angle(value); }
  [[nodiscard]] static constexpr Angle degrees(double value) { return Angle(value * (std::numbers::pi / 180.0)); }

  [[nodiscard]] constexpr double radians() const { return radians_; }
  [[nodiscard]] constexpr double degrees() const { return radians_ * (180.0 / std::numbers::pi); }

  constexpr auto operator<=>(const Angle&) const = default;
  constexpr Angle operator-() const { return Angle(-radians_); }
  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.radians_ + b.radians_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.radians_ - b.radians_); }
  friend constexpr Angle operator*(double s, Angle a) { return Angle(s * a.radians_); }

 private:
  explicit constexpr Angle(double value) : radians_(value) {}
  double radians_ = 0.0;
};

[[nodiscard]] inline double sin(Angle a) { return std::sin(a.radians()); }
[[nodiscard]] inline double cos(Angle a) { return std::cos(a.radians()); }
[[nodiscard]] inline double tan(Angle a) { return std::tan(a.radians()); }

}  // namespace farlod
