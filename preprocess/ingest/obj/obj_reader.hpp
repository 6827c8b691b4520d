// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/city_writer.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/ingest_settings.hpp"

namespace farlod {

/// How the coordinates of a mesh lie in its CRS.
struct ObjFrame {
  Point3d origin;  ///< added to them, after turning them upright
  UpAxis up = UpAxis::z;
};

/// Reads an OBJ file. Each group (`g`) is a building, or each object (`o`) where it has more than one; without either, what
/// hangs together. A name that comes again starts another building. Coplanar neighbors share a surface number. Throws InputError
/// when there are no faces.
void read_obj(const InputFile& file, const ObjFrame& frame, CityWriter& writer);

}  // namespace farlod
