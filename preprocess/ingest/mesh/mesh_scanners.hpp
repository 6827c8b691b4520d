// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ingest/files/input_file.hpp"
#include "ingest/mesh/mesh.hpp"

namespace farlod::ingest {

// Readers of small formats. Each throws InputError for a file that is cut short, or that is not of the format.

/// STL, as text or binary. Several solids of a text are objects.
[[nodiscard]] Mesh scan_stl(const InputFile& file);

/// PLY: the coordinates of `vertex`, and the lists of `face`; as text, little-endian or big-endian.
[[nodiscard]] Mesh scan_ply(const InputFile& file);

/// Binary glTF 2.0: the triangles of its scene. A node with a mesh is an object. What CESIUM_RTC says is added in double.
[[nodiscard]] Mesh scan_glb(const InputFile& file);

}  // namespace farlod::ingest
