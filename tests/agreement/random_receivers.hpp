// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Places and directions that are the same on every machine.
class RandomSky {
 public:
  [[nodiscard]] double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  [[nodiscard]] Point3d direction_above_horizon() {
    const double z = uniform(0.0, 1.0), azimuth = uniform(0.0, 2.0 * std::numbers::pi), r = std::sqrt(1.0 - z * z);
    return {r * std::sin(azimuth), r * std::cos(azimuth), z};
  }
  /// A receiver 1.5 m above the ground, outside of buildings, anywhere in the grid.
  [[nodiscard]] CellReceivers receiver(const PackageReader& package) {
    const CellRange& cells = package.grid().cells;
    while (true) {
      const Cell cell = cells.cell_at(static_cast<std::size_t>(uniform(0.0, static_cast<double>(cells.size()))));
      const auto edge = package.grid().cell_edge_m;
      const auto p = stand(PointLocator(package, cell), static_cast<float>(uniform(0, edge)),
                           static_cast<float>(uniform(0, edge)), HeightAbove::ground, 1.5F);
      if (p) return {cell, {{0, *p}}};
    }
  }

 private:
  std::mt19937_64 random_{20120901};
};

}  // namespace farlod
