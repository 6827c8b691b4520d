// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/package_facts.hpp"
#include "farlod/run.hpp"
#include "results/picture/city_picture.hpp"

namespace farlod {

/// What the picture of a whole city shows. The report, of which the places are taken, may have no name: then there is none.
/// Throws PointsError, and what plan_heights throws.
[[nodiscard]] CityScenery city_scenery(const Package& package, const PackageFacts& facts, const std::filesystem::path& report,
                                       const RunSettings& run);

}  // namespace farlod
