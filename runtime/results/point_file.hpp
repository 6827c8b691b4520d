// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "inputs/requested_points.hpp"

namespace farlod {

/// Whether a file is a table of points, by the ending of its name: .csv, .tsv or .txt.
[[nodiscard]] bool is_point_table(const std::filesystem::path& file);

/// Reads points from a vector file, as read_points_gdal, where the ending of its name is that of one, and else from a table, as
/// read_points_csv. A table has no layers, and a program without GDAL reads no vector files. Throws PointsError.
[[nodiscard]] RequestedPoints read_point_file(const std::filesystem::path& file, const std::string& layer = {},
                                              bool may_be_empty = false);

/// The points of a file, which may have none, in a CRS, without rows that have no place. Those of a file that says no CRS are
/// taken as they are. Throws PointsError.
[[nodiscard]] RequestedPoints read_points_in(const std::string& crs_wkt, const std::filesystem::path& file);

}  // namespace farlod
