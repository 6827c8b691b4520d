// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"
#include "results/city/city_file.hpp"

namespace farlod {

/// The rings of a polygon: the outer one first.
using FileRing = std::vector<Point3d>;
using FileRings = std::vector<FileRing>;

/// Sets the area and the steepness of a polygon.
void measure(const FileRings& rings, NumberedPolygon& polygon);

/// The distinct corners in ascending order: two polygons with the same ones are one surface, whichever way they face.
using FileCorners = std::vector<std::array<double, 3>>;
[[nodiscard]] FileCorners corners_of(const FileRings& rings);

/// The levels of detail with usable surfaces, of the building itself (first) and of each part.
using LodsOfParts = std::vector<std::vector<double>>;

/// One level for the whole building. A part that lacks it has its own best; the building itself, which would enclose the parts
/// again, has none.
[[nodiscard]] std::vector<std::optional<double>> chosen_lods(const LodsOfParts& lods_of_parts, PackedLod choice);

/// The kinds that farlod-pack takes from a file. Surfaces of other names are of the kind of their normal.
[[nodiscard]] SurfaceKind kind_of_semantics(std::string_view name);

}  // namespace farlod
