// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/openstreetmap_areas_gdal.hpp"

#include <cpl_vsi.h>

#include <string_view>

namespace farlod::ingest {
namespace {

/// The keys of closed ways that are areas are those of GDAL, and `building:part`. All tags but `building` come in `other_tags`.
constexpr std::string_view areas =
    "closed_ways_are_polygons=aeroway,amenity,boundary,building,building:part,craft,geological,historic,landuse,leisure,"
    "military,natural,office,place,shop,sport,tourism,highway=platform,public_transport=platform\n"
    "[points]\nosm_id=yes\n"
    "[lines]\nosm_id=yes\n"
    "[multipolygons]\nosm_id=yes\nattributes=name,building\n"
    "[multilinestrings]\nosm_id=yes\n"
    "[other_relations]\nosm_id=yes\n";

std::string written() {
  std::string name = "/vsimem/farlod_openstreetmap_areas.ini";
  VSILFILE* file = VSIFOpenL(name.c_str(), "wb");
  if (file == nullptr) return "";
  VSIFWriteL(areas.data(), 1, areas.size(), file);
  VSIFCloseL(file);
  return name;
}

}  // namespace

const std::string& file_of_openstreetmap_areas() {
  static const std::string name = written();
  return name;
}

}  // namespace farlod::ingest
