// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "farlod/point.hpp"
#include "ingest/lod_choice.hpp"

namespace farlod {

/// Which axis of an OBJ file points upwards.
enum class UpAxis { z, y };

struct IngestSettings {
  std::optional<std::string> height_field;        ///< attribute of footprints: height above the base
  std::optional<std::string> base_field;          ///< attribute of footprints: elevation of the base
  std::optional<std::string> storeys_field = {};  ///< attribute of footprints: number of storeys
  double floor_height_m = 3.0;                    ///< of a storey, for footprints that only say how many they have
  std::optional<std::string> roof_field = {};     ///< attribute of footprints: elevation of the roof
  std::optional<double> default_height_m;         ///< of footprints without a height of their own
  LodChoice lod;                                  ///< CityGML and CityJSON
  std::optional<Point3d> obj_origin;              ///< added to the coordinates of OBJ files, after turning them upright
  UpAxis up = UpAxis::z;                          ///< OBJ
};

}  // namespace farlod
