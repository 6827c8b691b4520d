// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

struct IngestSettings {
  FootprintSettings footprints;
  LodChoice lod;                          ///< CityGML and CityJSON
  std::optional<Point3d> obj_origin;      ///< added to the coordinates of meshes, after turning them upright
  std::optional<UpAxis> up;               ///< of meshes; empty: as the format has it
  std::vector<std::string> ground_names;  ///< of objects, groups and materials of meshes, besides those that are known
};

/// Reads one file of a city: in a format of input_formats(), or footprints in any other that GDAL knows. For every file:
///   (1) coordinates are handed on as the file has them, in its own axis order;
///   (2) a building comes in one level of detail, and each of its polygons once;
///   (3) rings have at least three different points, no vertex twice in a row, and only finite coordinates;
///   (4) what is left out or repaired is in the report;
///   (5) its content decides which format it is; its name decides only where the content does not.
/// Throws InputError when the file as a whole cannot be used, or when neither a building nor a point of a relief is left;
/// Cancelled when a stop is requested while CityGML is read.
[[nodiscard]] SourceCity ingest(const InputFile& file, const IngestSettings& settings, Report& report,
                                const std::stop_token& stop = {});

/// Reads the files of a city, up to four at a time on the threads of the task arena that it is called in. Cities and problems are
/// in the order of the files. If there are several, a file that is empty or cannot be used as a whole is reported and left out.
/// Throws InputError when none is left, and Cancelled when a stop is requested. A single file is read as `ingest` reads it. The
/// header of CityJSONFeatures in other files is no city.
[[nodiscard]] std::vector<SourceCity> ingest_all(std::span<const InputFile> found, const IngestSettings& settings, Report& report,
                                                 const std::stop_token& stop = {});

}  // namespace farlod::ingest
