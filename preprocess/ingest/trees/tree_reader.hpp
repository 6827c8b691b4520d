// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stop_token>

#include "city/tree.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"

namespace farlod::ingest {

/// Reads an inventory of trees, from a file whose content decides which format it is: CityGML and CityJSON as city_trees.hpp
/// says, any other as feature_trees.hpp does. TreeSizes fills in what is missing. What is left out, filled in or doubtful is in
/// the report, an entry for each kind of problem. Throws InputError when the file cannot be read to its end, or holds no tree;
/// Cancelled.
[[nodiscard]] SourceTrees read_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                                     const std::stop_token& stop = {});

}  // namespace farlod::ingest
