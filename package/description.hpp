// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/package.hpp"
#include "package/manifest.hpp"

namespace farlod::package {

/// What users are told of a package.
[[nodiscard]] inline PackageDescription described(const Manifest& m) {
  PackageDescription d;
  d.software = m.software;
  d.crs_wkt = m.crs_wkt;
  d.crs_name = m.crs_name;
  d.epsg = m.epsg;
  d.outline_projected = m.projected_outline(m.grid.rectangle());
  d.grid_bearing = m.grid.rotation.bearing();
  d.convergence = m.convergence;
  d.cell_edge_m = m.grid.cell_edge_m;
  d.neighborhood = m.grid.neighborhood;
  d.columns = m.grid.cells.width();
  d.rows = m.grid.cells.height();
  d.far_map_kind = m.far_map.kind;
  d.cells_with_far_map = m.cells_with_far_map();
  d.buildings = m.buildings;
  d.polygons = m.polygons;
  d.triangles = m.triangles;
  d.manifest_xxh3 = m.file_xxh3;
  return d;
}

}  // namespace farlod::package
