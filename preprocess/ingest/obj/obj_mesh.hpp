// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <numeric>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "base/paging/paged_array.hpp"
#include "farlod/point.hpp"

namespace farlod::ingest {

/// Union-find. The representative of a set is its smallest member, so that it does not depend on the order of joins.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  [[nodiscard]] std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[a < b ? b : a] = a < b ? a : b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The step to which exporters of meshes round coordinates.
inline constexpr double coordinate_rounding_m = 1e-3;

/// The corners of the polygons of a mesh: face f has the corners [first_corner[f], first_corner[f + 1]).
struct FaceCorners {
  std::vector<Point3d> points;
  std::vector<std::uint32_t> first_corner{0};

  [[nodiscard]] std::size_t face_count() const { return first_corner.size() - 1; }
  [[nodiscard]] std::span<const Point3d> face(std::size_t f) const {
    return std::span(points).subspan(first_corner[f], first_corner[f + 1] - first_corner[f]);
  }
  void end_face() { first_corner.push_back(static_cast<std::uint32_t>(points.size())); }
};

/// Numbers points. Points with equal coordinates have the same number.
[[nodiscard]] std::vector<std::uint32_t> weld(std::span<const Point3d> points);

/// The number of the planar face that each face of the mesh belongs to, counted in the order of the faces.
///   (1) Two faces belong together if they share an edge and are coplanar within the rounding of coordinates: the apex of one
///   lies
///       no farther from the plane of the other than a movement of all four points by half a rounding step can explain.
///   (2) A face thinner than the rounding has no plane. It joins one neighbor, and never connects two.
[[nodiscard]] std::vector<std::uint32_t> number_planar_faces(const FaceCorners& mesh);

struct ObjFace {
  std::uint64_t first_corner = 0;
  std::uint32_t corner_count = 0;
  std::uint32_t group = 0, object = 0, material = 0;  ///< rows in the lists of names
  std::uint64_t line = 0;                             ///< for messages
};

/// The content of an OBJ file, in its order and with its axes, without textures and normals.
struct ObjMesh {
  PagedArray<Point3d> vertices;      ///< a coordinate that cannot be read is NaN
  PagedArray<std::int64_t> corners;  ///< vertices counted from 0, not checked against the range yet
  PagedArray<ObjFace> faces;
  /// One row for each statement, even when it repeats a name. Row 0 holds the faces before the first statement.
  std::vector<std::string> groups{""}, objects{""}, materials{""};
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
  ObjMesh mesh;  ///< row 0 of its groups and objects holds the faces before its first statement
  /// Places in the corners of those that the file counts backwards. They may be vertices of earlier segments: negative numbers.
  std::vector<std::size_t> relative_corners;
  std::uint64_t lines = 0;
};

/// Adds the next segment of a file to what the mesh has of those before it, which have so many lines.
void append(ObjSegment&& next, std::uint64_t lines_before, ObjMesh& mesh);

}  // namespace farlod::ingest
