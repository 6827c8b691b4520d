// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "base/grid.hpp"
#include "package/crown.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// How far from its axis a crown may reach in the plan, at the most.
[[nodiscard]] inline double reach_m(const Crown& crown) {
  const double half_width_m = crown.half_width_m;
  return crown.shape == CrownShape::prism ? std::numbers::sqrt2 * half_width_m : half_width_m;
}

/// The crowns that reach, in the plan, to within a distance of the square of `cell`, in the frame of `cell`, and perhaps some
/// prisms that just fail to. In the order of the package: cell by cell. Places are moved and rounded as `placed`
/// (occlusion/placed_mesh.hpp) does it.
[[nodiscard]] std::vector<Crown> crowns_near(const PackageReader& package, Cell cell, double distance_m);

/// At least as many as crowns_near gives, and perhaps others nearby.
[[nodiscard]] std::size_t count_crowns_near(const PackageReader& package, Cell cell, double distance_m);

/// All crowns of a package, in the frame of `cell`, in the same order. That of the middle cell has the frame of WholeCity.
[[nodiscard]] std::vector<Crown> crowns_of_whole_city(const PackageReader& package, Cell cell);

}  // namespace farlod
