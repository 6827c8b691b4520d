// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "farlod/package.hpp"
#include "farlod/raster.hpp"

namespace farlod {

/// Whether the plan of a building covers the middle of a pixel, row by row from the north; of all buildings that share the id.
/// One that covers no middle has the pixels of its corners. Throws what geometry_of throws.
[[nodiscard]] std::vector<bool> plan_of_building(const Package& package, const std::string& id, const RasterPlan& plan);

}  // namespace farlod
