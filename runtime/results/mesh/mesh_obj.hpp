// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farlod/inspection.hpp"

namespace farlod {

/// Writes geometry as a Wavefront OBJ file: a group for the ground and for each building, z up, coordinates to a tenth of a
/// millimetre, less an offset in whole metres that a comment tells. `remarks` are further comments, a line each. Throws
/// OutputError.
void write_obj(const std::vector<MeshPart>& parts, Point2d offset_m, const std::vector<std::string>& remarks,
               const std::filesystem::path& path);

}  // namespace farlod
