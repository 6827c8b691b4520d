// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/crs_gdal.hpp"

#include <cpl_error.h>
#include <ogr_spatialref.h>

namespace farlod {

bool read_crs(OGRSpatialReference& crs, const std::string& wkt, std::optional<int> epsg) {
  // PROJ knows the names of a code already; for WKT it looks each of them up, which takes longer than a small map
  const bool is_known = (epsg && crs.importFromEPSG(*epsg) == OGRERR_NONE) || crs.importFromWkt(wkt.c_str()) == OGRERR_NONE;
  if (!is_known) CPLError(CE_Failure, CPLE_AppDefined, "the coordinate reference system is not valid WKT");
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return is_known;
}

}  // namespace farlod
