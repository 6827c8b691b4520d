// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stop_token>

#include "city/tree.hpp"
#include "farlod/pack.hpp"
#include "farlod/problem.hpp"

namespace farlod::ingest {

/// Reads the trees of a vector file that GDAL reads.
///   (1) a point is a tree; of several points of a feature, each is one
///   (2) an area is the outline of a crown: the tree stands at its centroid; where no field says the crown's diameter, it is that
///       of a circle of the same area
///   (3) where the file has no geometries, two of its columns are the coordinates: longitude and latitude in WGS 84, or x and y
///       in a CRS that the file does not say
///   (4) the sizes are those that TreeFields finds
/// The first of several layers with points or areas is read (of those, the first with the height field that the settings name);
/// others are in the report. Features that OpenStreetMap calls something else than a tree are not read. Throws InputError when
/// the file cannot be read, or holds no tree; Cancelled.
[[nodiscard]] SourceTrees read_feature_trees(const std::filesystem::path& file, const TreeSettings& settings, Report& report,
                                             const std::stop_token& stop);

}  // namespace farlod::ingest
