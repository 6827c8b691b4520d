// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/wkt_gdal.hpp"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <array>

namespace farlod {

std::string wkt_of(const OGRSpatialReference* reference) {
  if (reference == nullptr) return {};
  char* wkt = nullptr;
  const std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
  const bool is_good = reference->exportToWkt(&wkt, options.data()) == OGRERR_NONE;
  std::string text = is_good && wkt != nullptr ? wkt : "";
  CPLFree(wkt);
  return text;
}

}  // namespace farlod
