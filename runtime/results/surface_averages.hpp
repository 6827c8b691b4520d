// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "results/sky_table.hpp"

namespace farlod {

/// The paper's façade averages: for each surface, the area-weighted mean over its receivers that have an answer; a surface whose
/// receivers have none keeps its row, without a value. In the order in which surfaces are first met. A building's id and a
/// surface's number together name a surface.
[[nodiscard]] std::vector<SurfaceRow> average_by_surface(std::span<const SurfacePointRow> receivers);

/// The same for the roofs and for the walls of each building.
[[nodiscard]] std::vector<BuildingRow> average_by_building(std::span<const SurfacePointRow> receivers);

}  // namespace farlod
