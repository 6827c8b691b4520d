// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

// Private to the wrappers of GDAL: it names one of its classes.
class OGRSpatialReference;

namespace farlod {

/// Fills `crs` by the code or, where there is none, the WKT. Coordinates of it are easting and northing, whatever it declares.
/// False, and an error of GDAL's, where the WKT is none.
[[nodiscard]] bool read_crs(OGRSpatialReference& crs, const std::string& wkt, std::optional<int> epsg);

}  // namespace farlod
