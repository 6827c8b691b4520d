// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "city/city_model.hpp"
#include "contract/grid.hpp"
#include "farmap/far_map_settings.hpp"

namespace farlod::pipeline {

/// The expected cost of a run, estimated when the grid is known. An estimate, not a bound.
struct PackEstimate {
  std::uint64_t cells = 0;
  double seconds = 0.0;  ///< of the stages from the tiles on
  double memory_mib = 0.0, package_mib = 0.0;
};

/// The run is expected to need more memory than its limit.
class MemoryLimitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Estimates memory and package size within a factor of two for cities of grounded buildings (Surface::grounded); cities of open
/// shells have larger far maps. `ground_points`: nodes of a terrain or points of a relief, 0 without either. The time is that of
/// an idle machine like the one of docs/performance.md.
[[nodiscard]] PackEstimate estimate_pack(const CityModel& city, std::size_t ground_points, const Grid& grid, FarMapKind far_map,
                                         std::size_t threads);

/// Throws MemoryLimitError, whose message has remedies, when the estimate exceeds the limit.
void require_memory(const PackEstimate& estimate, std::optional<std::uint64_t> limit_mib);

}  // namespace farlod::pipeline
