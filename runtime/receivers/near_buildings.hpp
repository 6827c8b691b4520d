// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <vector>

#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Tells of each receiver of a cell, which may lie beyond the grid, whether its distance in the plan to a roof or wall of a
/// building is `distance_m` at the most: exact, whichever cells the buildings lie in, and the same for whichever receivers it is
/// asked with. Empty where there are no receivers, or no buildings in the city. Throws Cancelled when `stop` is asked for.
[[nodiscard]] std::vector<bool> are_near_buildings(const PackageReader& package, const CellReceivers& cell, double distance_m,
                                                   const std::stop_token& stop = {});

}  // namespace farlod
