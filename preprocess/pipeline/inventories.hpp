// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "base/grid.hpp"
#include "city/city_model.hpp"
#include "city/tree.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "pipeline/pack.hpp"
#include "tiles/crowns_on_ground.hpp"

namespace farlod::pipeline {

/// The trees that the settings name, in the city frame.
struct ReadTrees {
  tiles::TreesOfCity trees;
  SkippedFeatures skipped;
  std::vector<std::string> notes;  ///< for the user
};

/// Reads inventories, and opens rasters of canopies: before the city is read, so that a wrong file is told first. If there are
/// several inventories, one that is empty or cannot be used as a whole is reported and left out. Throws InputError for a file
/// that does not exist, when no inventory is left, or when a raster cannot be opened; Cancelled.
[[nodiscard]] std::vector<SourceTrees> read_inventories(const StageSettings& stages, Report& report, const std::stop_token& stop);

/// Brings them to the city, and reads the raster of canopies where the grid is. Inventories without a usable CRS are left out as
/// before. Throws InputError when none is left, when none of all trees stands in the grid, or a raster cannot be used; Cancelled.
[[nodiscard]] ReadTrees bring_to_city(std::vector<SourceTrees> inventories, const StageSettings& settings,
                                      const Georeference& georeference, const Grid& grid, Report& report,
                                      const std::stop_token& stop);

}  // namespace farlod::pipeline
