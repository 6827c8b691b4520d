// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

// Private to the wrappers of GDAL: it names one of its classes.
class OGRSpatialReference;

namespace farlod {

/// Fills `crs` by the code or, where there is none, the WKT. Coordinates of it are easting and northing, whatever it declares.
/// False, and an error of GDAL's, where the WKT is none.
[[nodiscard]] bool read_crs(OGRSpatialReference& crs, const std::string& wkt, std::optional<int> epsg);

/// A CRS in the words of the CF conventions (appendix F): the attributes of a grid mapping variable.
struct CfGridMapping {
  std::string name;  ///< grid_mapping_name; empty where the conventions have no word for the projection
  std::vector<std::pair<std::string, std::vector<double>>> parameters;  ///< ellipsoid and projection; angles in degrees
};

/// Knows transverse Mercator, Lambert's conformal conic and azimuthal equal-area, Albers' conic and Mercator. Of other
/// projections the ellipsoid alone is told.
[[nodiscard]] CfGridMapping cf_grid_mapping_of(const std::string& wkt, std::optional<int> epsg);

/// The same CRS in the words of a .prj file (WKT 1 as ESRI speaks it): neither ESRI's programs nor GDAL 3.6 know WKT 2 there.
/// What cannot be said in them comes back as it is.
[[nodiscard]] std::string esri_wkt_of(const std::string& wkt);

}  // namespace farlod
