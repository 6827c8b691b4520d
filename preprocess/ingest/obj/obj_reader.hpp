// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

/// Which axis of an OBJ file points upwards.
enum class UpAxis { z, y };

/// How the coordinates of a mesh lie in its CRS.
struct ObjFrame {
  Point3d origin;  ///< added to them, after turning them upright
  UpAxis up = UpAxis::z;
};

/// Reads an OBJ file. Each group (`g`) is a building, or each object (`o`) where it has more than one; without either, each
/// connected component. A name that comes again starts another building. Coplanar neighbors share a surface number. Throws
/// InputError when there are no faces.
void read_obj(const InputFile& file, const ObjFrame& frame, CityModelBuilder& builder);

}  // namespace farlod::ingest
