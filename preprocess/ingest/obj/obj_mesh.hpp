// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::ingest {

struct ObjFace {
  std::uint64_t first_corner = 0;
  std::uint32_t corner_count = 0;
  std::uint32_t group = 0, object = 0;  ///< rows in the lists of names
  std::uint64_t line = 0;               ///< for messages
};

/// What an OBJ file says, in its order and axes. Textures, normals and materials are not kept.
struct ObjMesh {
  std::vector<Point3d> vertices;      ///< a coordinate that cannot be read is NaN
  std::vector<std::int64_t> corners;  ///< vertices counted from 0; anything out of range is the file's mistake
  std::vector<ObjFace> faces;
  /// One row for each statement, even when it repeats a name; row 0 is what comes before the first.
  std::vector<std::string> groups{""}, objects{""};
  std::vector<std::uint64_t> malformed_lines;                ///< faces whose corners are not numbers
  std::uint64_t unread_elements = 0, first_unread_line = 0;  ///< lines, points, curves: nothing that hides the sky
};

/// Reads the text of an OBJ file; never fails. Knows comments, CRLF, tabs, continued lines and relative vertex numbers.
[[nodiscard]] ObjMesh scan_obj(std::string_view text);

}  // namespace farlod::ingest
