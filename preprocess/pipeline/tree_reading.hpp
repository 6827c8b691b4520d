// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "city/located_city.hpp"
#include "contract/grid.hpp"
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

/// Throws InputError for a file that does not exist: told before the long stages.
void require_trees_exist(const TreeSettings& settings);

/// Reads inventories and rasters of canopies, the latter where the grid is. If there are several inventories, one that is empty
/// or cannot be used as a whole is reported and left out. Throws InputError when none is left, or a raster cannot be used;
/// Cancelled.
[[nodiscard]] ReadTrees read_trees(const StageSettings& settings, const Georeference& georeference, const Grid& grid,
                                   Report& report, const std::stop_token& stop);

}  // namespace farlod::pipeline
