// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "package/sources_layout.hpp"

namespace farlod {

/// What a file says of its coordinate reference system.
struct SourceCrs {
  /// "EPSG:n", a URN, a URL, an AdV name or WKT, as found in the file; empty when the file does not say.
  std::string definition;
  /// x is the longitude whatever the definition's axis order says (GeoJSON, and all that GDAL hands out).
  bool longitude_first = false;
  /// z is in metres whatever the horizontal unit is (heights taken from an attribute).
  bool heights_in_metres = false;
};

/// A city file into whose text attributes can be inserted: CityModel::origin_of has the places.
struct PlacedFile {
  std::filesystem::path path;
  package::CityFileFormat format = package::CityFileFormat::citygml;
  std::vector<package::AttributeForm> forms;
};

/// One input file, read: coordinates are still those of the file.
struct SourceCity {
  std::string source;  ///< the file's name as the user gave it
  SourceCrs crs;
  CityModel city;
  std::vector<Point3d> relief_points = {};  ///< corners of the triangles that the file gives as terrain; may repeat
  SkippedFeatures skipped = {};
  std::vector<std::string> notes = {};  ///< for the user: what was taken from elsewhere, or guessed
  std::optional<PlacedFile> placed = {};
};

}  // namespace farlod
