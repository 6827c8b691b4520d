// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "ingest/mesh/mesh.hpp"

namespace farlod::ingest {

/// Parsing a segment is much more work than starting to.
inline constexpr std::size_t obj_segment_bytes = std::size_t{1} << 18;

/// Reads the text of an OBJ file, with comments, CRLF, tabs, continued lines and relative vertex numbers, on all threads of the
/// task arena that it is called in. The size of the segments that these parse changes nothing. Throws what reading the stream
/// throws, and Cancelled when a stop is requested.
[[nodiscard]] Mesh scan_obj(std::istream& text, const std::stop_token& stop = {}, std::size_t segment_bytes = obj_segment_bytes);

/// Cuts the text of an OBJ file into segments, each of which ends with a line that is not continued.
class ObjSegmentCutter {
 public:
  /// The stream must outlive this. A segment has so many bytes, or more where its last line is long.
  ObjSegmentCutter(std::istream& text, std::size_t segment_bytes) : text_(text), segment_bytes_(segment_bytes) {}

  /// The next segment; empty after the last. Throws what reading the stream throws.
  [[nodiscard]] std::optional<std::string> next();

 private:
  [[nodiscard]] bool read_on();

  std::istream& text_;
  std::size_t segment_bytes_;
  std::string ahead_;  ///< what was read and not handed out yet
  bool is_first_ = true;
};

/// What a segment says by itself, as if the file began with it.
struct ObjSegment {
  Mesh mesh;  ///< row 0 of its groups and objects holds the faces before its first statement
  /// Places in the corners of those that the file counts backwards. They may be vertices of earlier segments: negative numbers.
  std::vector<std::size_t> relative_corners;
  std::uint64_t lines = 0;
};

/// Adds the next segment of a file to what the mesh has of those before it, which have so many lines.
void append(ObjSegment&& next, std::uint64_t lines_before, Mesh& mesh);

}  // namespace farlod::ingest
