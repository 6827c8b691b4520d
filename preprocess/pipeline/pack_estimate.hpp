// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "city/city_model.hpp"
#include "farlod/grid.hpp"
#include "farmap/far_map_settings.hpp"

namespace farlod {

/// What a run will need, expected once the grid is laid: to plan by, not to rely on.
struct PackEstimate {
  std::uint64_t cells = 0;
  double seconds = 0.0;  ///< from the tiles on
  double memory_mib = 0.0, package_mib = 0.0;
};

/// The run would need more than it may.
class MemoryLimitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Expects memory and package within a factor of two, for cities whose buildings stand (Surface::is_grounded): those of open shells
/// have larger far maps. `ground_points`: nodes of a terrain or points of a relief; 0 when buildings stand on their own. Time is
/// that of a machine like that of docs/performance.md with nothing else to do.
[[nodiscard]] PackEstimate estimate_pack(const CityModel& city, std::size_t ground_points, const Grid& grid, FarMapKind far_map,
                                         std::size_t threads);

/// Throws MemoryLimitError, which says what would help, when the estimate exceeds the limit.
void require_memory(const PackEstimate& estimate, std::optional<std::uint64_t> limit_mib);

}  // namespace farlod
