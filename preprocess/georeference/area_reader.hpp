// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "city/area.hpp"
#include "city/located_city.hpp"

namespace farlod::georeference {

/// An area as it was asked for, in parts, each in its own CRS.
struct RequestedArea {
  struct Part {
    Area shapes;
    std::string crs_wkt;  ///< empty: that of the package
  };
  std::string name;  ///< for messages
  std::vector<Part> parts;
};

/// Reads an area from a file.
///   (1) a table (.csv, .tsv, .txt) holds points, in the columns that base/point_columns.hpp names (without a header row: x
///       and y), in the CRS of the package
///   (2) of any other vector file that GDAL reads, all points, lines and polygons of all layers count; arcs become chords
/// Throws InputError when the file cannot be read to its end, or holds nothing of this.
[[nodiscard]] RequestedArea read_area(const std::filesystem::path& file);

/// Brings an area to the city frame, point by point. Throws InputError when a part is in a CRS that is not known, or has a point
/// without a place in the CRS of the package.
[[nodiscard]] Area located(const RequestedArea& area, const Georeference& georeference);

}  // namespace farlod::georeference
