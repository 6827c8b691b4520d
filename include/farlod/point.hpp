// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace farlod {

/// Points and vectors of the plane. Metres, unless the name says otherwise.
struct Point2d {
  double x = 0.0, y = 0.0;
  bool operator==(const Point2d&) const = default;
};

/// Points and vectors of space: right-handed, z up. Metres, unless the name says otherwise.
template <class T>
struct Point3 {
  T x{}, y{}, z{};
  bool operator==(const Point3&) const = default;
};

using Point3d = Point3<double>;
using Point3f = Point3<float>;

[[nodiscard]] constexpr Point2d operator+(Point2d a, Point2d b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Point2d operator-(Point2d a, Point2d b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Point2d operator*(double s, Point2d a) { return {s * a.x, s * a.y}; }
[[nodiscard]] constexpr double dot(Point2d a, Point2d b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double norm(Point2d a) { return std::hypot(a.x, a.y); }

template <class T>
[[nodiscard]] constexpr Point3<T> operator+(const Point3<T>& a, const Point3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
[[nodiscard]] constexpr Point3<T> operator-(const Point3<T>& a, const Point3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
[[nodiscard]] constexpr Point3<T> operator*(T s, const Point3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
[[nodiscard]] constexpr T dot(const Point3<T>& a, const Point3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[nodiscard]] constexpr Point3<T> cross(const Point3<T>& a, const Point3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
[[nodiscard]] T norm(const Point3<T>& a) {
  return std::sqrt(dot(a, a));
}
/// The vector of length 1 along `a`; the zero vector stays zero.
template <class T>
[[nodiscard]] Point3<T> normalized(const Point3<T>& a) {
  const T length = norm(a);
  return length > T(0) ? Point3<T>{a.x / length, a.y / length, a.z / length} : Point3<T>{};
}
[[nodiscard]] constexpr Point2d horizontal(const Point3d& p) { return {p.x, p.y}; }

}  // namespace farlod
