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

/// The content of an OBJ file, in its order and with its axes, without textures, normals and materials.
struct ObjMesh {
  std::vector<Point3d> vertices;      ///< a coordinate that cannot be read is NaN
  std::vector<std::int64_t> corners;  ///< vertices counted from 0, not checked against the range yet
  std::vector<ObjFace> faces;
  /// One row for each statement, even when it repeats a name. Row 0 holds the faces before the first statement.
  std::vector<std::string> groups{""}, objects{""};
  std::vector<std::uint64_t> malformed_lines;                ///< faces whose corners are not numbers
  std::uint64_t unread_elements = 0, first_unread_line = 0;  ///< points, lines and curves, which are not read
};

/// Reads the text of an OBJ file, with comments, CRLF, tabs, continued lines and relative vertex numbers. Never fails.
[[nodiscard]] ObjMesh scan_obj(std::string_view text);

}  // namespace farlod::ingest
