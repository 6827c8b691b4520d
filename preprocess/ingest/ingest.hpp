// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "city/source.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "ingest/lod_choice.hpp"

namespace farlod {

/// Which axis of an OBJ file points upwards.
enum class UpAxis { z, y };

struct IngestSettings {
  std::optional<std::string> height_field;  ///< attribute of footprints: height above the base
  std::optional<std::string> base_field;    ///< attribute of footprints: elevation of the base, metres
  std::optional<double> default_height_m;   ///< of footprints without a height of their own
  LodChoice lod;                            ///< CityGML and CityJSON
  Point3d obj_origin;                       ///< added to the coordinates of an OBJ file, after turning it upright
  UpAxis up = UpAxis::z;                    ///< OBJ
};

/// Reads one file of buildings: CityGML, CityJSON, OBJ, or footprints in any format that GDAL knows. For every file:
///   (1) coordinates are handed on as the file has them, in its own axis order;
///   (2) a building comes in one level of detail, and each of its polygons once;
///   (3) rings have at least three different points, no vertex twice in a row, and only finite coordinates;
///   (4) what is left out or repaired is in the report.
/// Throws InputError when the file as a whole cannot be used, or when no building is left.
[[nodiscard]] SourceCity ingest(const std::filesystem::path& file, const IngestSettings& settings, Report& report);

}  // namespace farlod
