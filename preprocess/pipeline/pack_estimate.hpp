// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "city/city_model.hpp"
#include "contract/grid.hpp"
#include "farlod/pack.hpp"
#include "farmap/far_map_settings.hpp"

namespace farlod::pipeline {

/// Estimates memory and package size within a factor of two for cities of grounded buildings (Surface::grounded); cities of open
/// shells have larger far maps. `ground_points`: nodes of a terrain or points of a relief, 0 without either. The time is that of
/// an idle machine like the one of docs/performance.md. `far_maps` are baked, of all cells when absent.
[[nodiscard]] PackEstimate estimate_pack(const CityModel& city, std::size_t ground_points, const Grid& grid, FarMapKind far_map,
                                         std::size_t threads, std::optional<std::uint64_t> far_maps = {});

/// Throws LimitReached, whose message says what to do, when the estimate exceeds the limit.
void require_memory(const PackEstimate& estimate, const RunSettings& run);

}  // namespace farlod::pipeline
