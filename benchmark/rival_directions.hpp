// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::benchmark {

/// Directions around the z axis whose mean is a cosine-weighted view factor: a spherical Fibonacci lattice (u = (i + ½)/n,
/// azimuths one golden angle apart) mapped to the hemisphere by r = √u. At the same number of rays its error is below that of
/// random or stratified directions.
[[nodiscard]] std::vector<Point3d> fibonacci_directions(std::size_t count);

/// The order in which directions are traced.
enum class DirectionOrder {
  as_given,  ///< successive ones of the lattice are far apart
  curve      ///< along a space-filling curve over the disk under the hemisphere: successive ones meet the same part of the city
};
void put_in_order(DirectionOrder order, std::vector<Point3d>& directions);

/// Turned from the z axis to a normal of length 1; those that point below the horizon are left out.
[[nodiscard]] std::vector<Point3f> directions_around(std::span<const Point3d> local, const Point3f& normal);

}  // namespace farlod::benchmark
