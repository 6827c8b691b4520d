// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <istream>
#include <stop_token>
#include <string>
#include <vector>

#include "base/paging/paged_array.hpp"
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
  PagedArray<Point3d> vertices;      ///< a coordinate that cannot be read is NaN
  PagedArray<std::int64_t> corners;  ///< vertices counted from 0, not checked against the range yet
  PagedArray<ObjFace> faces;
  /// One row for each statement, even when it repeats a name. Row 0 holds the faces before the first statement.
  std::vector<std::string> groups{""}, objects{""};
  std::vector<std::uint64_t> malformed_lines;                ///< faces whose corners are not numbers
  std::uint64_t unread_elements = 0, first_unread_line = 0;  ///< points, lines and curves, which are not read

  /// Gives back the memory of what lies on disk. What is asked for later is read again.
  void let_go() const {
    vertices.let_go();
    corners.let_go();
    faces.let_go();
  }
};

/// Parsing a segment is much more work than starting to.
inline constexpr std::size_t obj_segment_bytes = std::size_t{1} << 18;

/// Reads the text of an OBJ file, with comments, CRLF, tabs, continued lines and relative vertex numbers, on all threads of the
/// task arena that it is called in. The size of the segments that these parse changes nothing. Throws what reading the stream
/// throws, and Cancelled when a stop is requested.
[[nodiscard]] ObjMesh scan_obj(std::istream& text, const std::stop_token& stop = {},
                               std::size_t segment_bytes = obj_segment_bytes);

}  // namespace farlod::ingest
