// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "evaluate/sky_evaluator.hpp"
#include "farlod/point.hpp"
#include "package/package_reader.hpp"
#include "receivers/surface_receivers.hpp"

namespace farlod::validation {

/// A receiver that belongs to no grid, so that the same may be asked of many packages of a city.
struct Site {
  Point3d p_city;  ///< absolute height
  Point3d normal_city{0.0, 0.0, 1.0};
};

/// Random places of some cells, 1.5 m above the ground and outside of buildings.
[[nodiscard]] std::vector<Site> ground_sites(const PackageReader& package, std::span<const Cell> cells, std::size_t count);
/// Random places on the roofs or walls in some cells, party walls left out; all that there are when they are fewer.
[[nodiscard]] std::vector<Site> surface_sites(const PackageReader& package, std::span<const Cell> cells, SurfaceChoice choice,
                                              std::size_t count);

[[nodiscard]] std::vector<Cell> all_cells(const Grid& grid);
/// The cells in which sites stand, in ascending order.
[[nodiscard]] std::vector<Cell> cells_of(const Grid& grid, std::span<const Site> sites);

struct SkyFigures {
  std::vector<double> svf, low, high;
};
/// Sky view factors of sites, and their certain bounds.
[[nodiscard]] SkyFigures sky_at(const PackageReader& package, const SkySettings& settings, std::span<const Site> sites);

/// How wide certain intervals are, and how many of the exact answers with the same rays are beyond them by more than a ray.
struct BoundsSummary {
  double mean_width = 0.0, max_width = 0.0;
  std::size_t outside = 0;
};
[[nodiscard]] BoundsSummary summarize_bounds(const SkyFigures& figures, std::span<const double> exact, std::size_t rays);

}  // namespace farlod::validation
