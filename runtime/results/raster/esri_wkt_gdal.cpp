// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/esri_wkt_gdal.hpp"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <array>
#include <memory>

#include "gdal/gdal_errors.hpp"

namespace farlod {

std::string esri_wkt_of(const std::string& wkt) {
  const GdalErrors errors;
  OGRSpatialReference crs;
  if (crs.importFromWkt(wkt.c_str()) != OGRERR_NONE) return wkt;
  constexpr std::array<const char*, 2> options{"FORMAT=WKT1_ESRI", nullptr};
  char* text = nullptr;
  const OGRErr refused = crs.exportToWkt(&text, options.data());
  const std::unique_ptr<char, decltype(&VSIFree)> owner(text, VSIFree);
  return refused == OGRERR_NONE ? std::string(text) : wkt;
}

}  // namespace farlod
