// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "farlod/point.hpp"

namespace farlod {

/// Longitudes and latitudes of the problems in a report of farlod-pack as JSON (--report FILE.json), but for those that have no
/// place; nothing where the file is no list in JSON. Throws PointsError where it is another one, or damaged.
[[nodiscard]] std::optional<std::vector<Point2d>> problem_places_in(const std::filesystem::path& file);

}  // namespace farlod
