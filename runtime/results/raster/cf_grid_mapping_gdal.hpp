// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace farlod {

/// A CRS in the words of the CF conventions (appendix F): the attributes of a grid mapping variable.
struct CfGridMapping {
  std::string name;  ///< grid_mapping_name; empty where the conventions have no word for the projection
  std::vector<std::pair<std::string, std::vector<double>>> parameters;  ///< ellipsoid and projection; angles in degrees
};

/// Knows transverse Mercator, Lambert's conformal conic and azimuthal equal-area, Albers' conic and Mercator. Of other
/// projections the ellipsoid alone is told.
[[nodiscard]] CfGridMapping cf_grid_mapping_of(const std::string& wkt, std::optional<int> epsg);

}  // namespace farlod
