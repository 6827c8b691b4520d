// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/paging/paged_array.hpp"
#include "farlod/pack.hpp"
#include "farlod/point.hpp"

namespace farlod::ingest {

struct MeshFace {
  std::uint64_t first_corner = 0;
  std::uint32_t corner_count = 0;
  std::uint32_t group = 0, object = 0, material = 0;  ///< rows in the lists of names
  std::uint64_t line = 0;                             ///< for messages: Mesh::places says what it counts
};

/// A point with its z upright.
[[nodiscard]] inline Point3d upright(UpAxis up, const Point3d& p) { return up == UpAxis::y ? Point3d{p.x, -p.z, p.y} : p; }

/// The content of a file of polygons, in its order and with its axes, without textures and normals.
struct Mesh {
  PagedArray<Point3d> vertices;      ///< a coordinate that cannot be read is NaN
  PagedArray<std::int64_t> corners;  ///< vertices counted from 0, not checked against the range yet
  PagedArray<MeshFace> faces;
  /// One row for each statement, even when it repeats a name. Row 0 holds the faces before the first statement.
  std::vector<std::string> groups{""}, objects{""}, materials{""};
  std::vector<std::uint64_t> malformed_lines;                ///< faces whose corners are not numbers
  std::uint64_t unread_elements = 0, first_unread_line = 0;  ///< points, lines and curves, which are not read
  std::string_view places = "line";                          ///< "face": MeshFace::line is the number of the face, from 1
  UpAxis up = UpAxis::z;                                     ///< what its format says
  Point3d origin = {};                                       ///< is added once it is upright

  /// Adds a face of the last group, object and material. Its number is its place.
  void add_face(std::span<const std::int64_t> corners_of_face) {
    const auto last = [](const auto& names) { return static_cast<std::uint32_t>(names.size() - 1); };
    faces.push_back({corners.size(), static_cast<std::uint32_t>(corners_of_face.size()), last(groups), last(objects),
                     last(materials), faces.size() + 1});
    for (const std::int64_t corner : corners_of_face) corners.push_back(corner);
  }

  /// Takes away the name of the one object of a format in which that is the name of the whole.
  void forget_lone_object() {
    if (objects.size() != 2 || groups.size() != 1) return;
    objects.pop_back();
    for (MeshFace& face : faces) face.object = 0;
  }

  /// Gives back the memory of what lies on disk. What is asked for later is read again.
  void let_go() const {
    vertices.let_go();
    corners.let_go();
    faces.let_go();
  }
};

}  // namespace farlod::ingest
