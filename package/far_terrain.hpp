// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/grid.hpp"
#include "base/mesh_view.hpp"
#include "package/horizon_edge.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// The ground beyond the grid, as far as somebody asked for it: to each cell, a part of the far city. Its frame is the grid frame
/// moved to the corner of the middle cell (Grid::middle_corner), with heights as in tiles.
struct FarTerrain {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;  ///< counter-clockwise seen from above
  std::vector<HorizonEdge> horizon_edges;

  [[nodiscard]] bool empty() const { return triangles.empty(); }
  [[nodiscard]] MeshView mesh() const { return {vertices, triangles}; }
};

/// The cell of what lies beyond the grid: it is near no other.
inline constexpr Cell beyond_grid{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};

namespace package {

/// The bytes of `far_terrain.bin`, which packages have that know the ground beyond their grid, and no others: a header, Point3f
/// for each vertex and Triangle for each triangle, without gaps between them. docs/package_format.md tells the same in words;
/// where they differ, this file wins.
inline constexpr std::uint32_t far_terrain_version = 1;
inline constexpr std::array<char, 8> far_terrain_magic{'F', 'A', 'R', 'L', 'O', 'D', 'R', '\n'};

struct FarTerrainHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t triangle_count;
  std::uint64_t file_bytes;
  std::uint32_t vertex_count;
  std::uint32_t reserved;  ///< zero, to be ignored
};
static_assert(sizeof(FarTerrainHeader) == 32);

}  // namespace package

/// The `far_terrain.bin` of a package, mapped. All is checked once: vertices lie somewhere on Earth, and triangles have vertices
/// that exist.
class FarTerrainFile {
 public:
  /// Opens that of a package whose manifest names it. Throws PackageDamaged or PackageUnusable.
  FarTerrainFile(const PackageFolder& folder, const package::Manifest& manifest);

  [[nodiscard]] const MeshView& mesh() const { return mesh_; }
  /// Gives the memory back. It stays readable, and comes back from the file when somebody reads it.
  void let_go() const { file_.let_go(); }

 private:
  void require(bool rule, const char* what) const { require_whole(rule, name_, what); }

  std::string name_;
  MappedFile file_;
  MeshView mesh_;
};

/// Writes `far_terrain.bin` into the folder of a package, which is made where there is none, and returns its stamp. Where there
/// is no far terrain, it returns nothing, and there is no file. Throws OutputError.
[[nodiscard]] std::optional<package::FileStamp> write_far_terrain(const std::filesystem::path& folder,
                                                                  const FarTerrain& far_terrain);

}  // namespace farlod
