// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>

#include "city/tree.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Reads each SolitaryVegetationObject and PlantCover of a city model.
///   (1) the tree stands at the reference point of its implicit geometry; without one, in the middle of its explicit geometry
///   (2) its sizes are `height`, `crownDiameter` and `trunkDiameter` (of which more than 3 m is centimetres); what is missing of
///       height and crown is as large as the explicit geometry
///   (3) a plant cover becomes what PlantCover (plant_cover.hpp) says
///   (4) everything else in the file is skipped
/// Throws InputError when the file is damaged, or holds no tree; Cancelled.
[[nodiscard]] SourceTrees read_citygml_trees(const InputFile& file, const TreeSettings& settings, Report& report,
                                             const std::stop_token& stop);
/// The same of CityJSON and CityJSONSeq. Holds a whole file, or a whole line of CityJSONSeq.
[[nodiscard]] SourceTrees read_cityjson_trees(const InputFile& file, const TreeSettings& settings, Report& report,
                                              const std::stop_token& stop);

}  // namespace farlod::ingest
