// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "farlod/point.hpp"
#include "results/picture/picture.hpp"
#include "results/spool_file.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// What the vertices of a file are joined to; the numbers are those of glTF.
enum class GlbPrimitive : std::uint8_t { points = 0, triangles = 4 };

/// A file of binary glTF 2.0: coloured vertices, which are points, or three each a triangle. Vertices wait on disk until the file
/// is complete. Their coordinates count from an origin, with the axes of glTF: x to the east, y upwards, z to the south. All
/// functions throw OutputError.
class GlbFile {
 public:
  /// The origin, the CRS and what made the file are in `asset.extras`.
  GlbFile(GlbPrimitive primitive, const Point3d& origin_m, const TableFrame& frame, const std::filesystem::path& path);

  void add(const Point3d& p_projected, Colour colour);
  /// The file appears now.
  void commit();

 private:
  void flush();
  [[nodiscard]] std::string json() const;

  GlbPrimitive primitive_;
  Point3d origin_m_;
  std::string asset_;
  std::filesystem::path path_;
  SpoolFile spool_;
  std::string waiting_;  ///< bytes that are not in the spool yet
  std::uint64_t vertices_ = 0;
  std::array<float, 3> low_{}, high_{};  ///< of all vertices
};

}  // namespace farlod
