// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/city_model.hpp"
#include "farlod/problem.hpp"
#include "ingest/files/input_file.hpp"

namespace farlod::ingest {

/// Reads a static driver of PALM (is_palm_driver).
///   (1) `zt` above `origin_z` becomes points of the ground, at the centres of the cells
///   (2) neighbouring cells of `buildings_2d` of one height are a prism; prisms of one `building_id` are a building
///   (3) `buildings_3d` counts before `buildings_2d`: what is free below a cell of a building stays free
///   (4) all is turned clockwise by `rotation_angle` about `origin_x`, `origin_y`
/// Throws InputError when a value that it needs is missing, or when its cells are not regular.
[[nodiscard]] SourceCity read_palm_driver(const InputFile& file, Report& report);

}  // namespace farlod::ingest
