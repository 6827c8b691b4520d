// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stop_token>

#include "farlod/pack.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/model_builder/city_model_builder.hpp"

namespace farlod::ingest {

/// How the coordinates of a mesh are brought into its CRS.
struct ObjFrame {
  Point3d origin;  ///< added to the coordinates after their vertical axis is z
  UpAxis up = UpAxis::z;
};

/// Reads an OBJ file. A building is a group (`g`); an object (`o`) if the file has more than one; or, without either, a connected
/// component. A repeated name begins another building. Coplanar neighboring faces share a surface number. Works on all threads of
/// the task arena that it is called in. Throws InputError when there are no faces, and Cancelled when a stop is requested.
void read_obj(const InputFile& file, const ObjFrame& frame, CityModelBuilder& builder, const std::stop_token& stop = {});

}  // namespace farlod::ingest
