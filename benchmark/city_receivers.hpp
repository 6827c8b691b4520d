// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod::benchmark {

/// Where the measured receivers stand.
enum class Place { ground, roofs, walls };
[[nodiscard]] const char* name_of(Place place);

/// Cells spread evenly over the grid; all of them when there are fewer.
[[nodiscard]] std::vector<Cell> spread_cells(const Grid& grid, std::size_t count);

/// Receivers by cell. Answers go to 0, 1, … count − 1.
struct CityReceivers {
  std::vector<CellReceivers> cells;
  std::size_t count = 0;
  double placing_s = 0.0;  ///< wall clock
};

/// On the ground: pixels of `spacing_m`, 1.5 m above it. On surfaces: a receiver for each square of that edge.
[[nodiscard]] CityReceivers place_receivers(const PackageReader& package, std::span<const Cell> cells, Place place,
                                            double spacing_m);

/// Random ones among them, those of choose_some(all.count, count), renumbered in the same order.
[[nodiscard]] CityReceivers choose_receivers(const CityReceivers& all, std::size_t count);

}  // namespace farlod::benchmark
