// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "farlod/pack.hpp"
#include "farlod/point.hpp"
#include "ingest/model_builder/lod_choice.hpp"
#include "ingest/obj/obj_reader.hpp"

namespace farlod::ingest {

struct IngestSettings {
  FootprintSettings footprints;
  LodChoice lod;                      ///< CityGML and CityJSON
  std::optional<Point3d> obj_origin;  ///< added to the coordinates of OBJ files, after turning them upright
  UpAxis up = UpAxis::z;              ///< OBJ
};

}  // namespace farlod::ingest
