// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "farlod/package.hpp"

namespace farlod {

/// A surface of a building: a polygon for each of its pieces that are not connected.
struct SurfacePolygons {
  std::string building;
  std::uint32_t surface = 0;     ///< its number within the building, as SurfaceMean has it
  std::string multipolygon_wkb;  ///< MultiPolygon Z in the package's CRS, ISO well-known binary, little endian
};

/// All surfaces of all buildings, by building and surface. The floors of the city are among them, the ground is not. Throws
/// Cancelled, PackageUnusable, PackageDamaged.
[[nodiscard]] std::vector<SurfacePolygons> surface_polygons(const Package& package, const std::stop_token& stop);

}  // namespace farlod
