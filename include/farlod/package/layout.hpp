// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "farlod/grid.hpp"
#include "farlod/horizon/horizon_edge.hpp"
#include "farlod/mesh_view.hpp"
#include "farlod/package/oct_normal.hpp"
#include "farlod/surface_kind.hpp"

/// The bytes of `tiles.bin`. docs/package_format.md tells the same in words; where they differ, this file wins.
/// All numbers are little-endian. Sections start at multiples of 64 bytes, and the file ends with 16 bytes of padding, so
/// that a section can be a vertex buffer whose last vertex is read as 16 bytes.
namespace farlod::package {

static_assert(std::endian::native == std::endian::little,
              "packages are mapped, not decoded: a big-endian reader must swap bytes");

inline constexpr std::uint32_t format_version = 6;
inline constexpr std::array<char, 8> magic{'F', 'A', 'R', 'L', 'O', 'D', 'T', '\n'};
inline constexpr std::uint64_t section_alignment = 64;
inline constexpr std::uint64_t end_padding = 16;

enum class SectionKind : std::uint32_t {
  cells = 1,         ///< CellRecord, row by row, every cell of the block that exists
  vertices = 2,      ///< Point3f, cell frame
  triangles = 3,     ///< Triangle; vertex numbers count from the cell's first vertex
  surface_runs = 4,  ///< SurfaceRun, cell by cell
  surfaces = 5,      ///< SurfaceRecord
  buildings = 6,     ///< BuildingRecord
  text = 7,          ///< bytes, UTF-8: the ids of buildings
  // Far maps of the kind `horizon`; without elements for the kind `box`
  far_cells = 8,     ///< FarCellRecord, as many and in the same order as `cells`
  far_edges = 9,     ///< HorizonEdge, block frame: what the cells' far maps name
  explicit_edges = 11,  ///< ExplicitOccluder: rows of `far_edges`, cell by cell
  // Of the tiles again
  tile_edges = 13,  ///< TileEdge, cell by cell, and within a cell role by role, in the order of EdgeRole
  loose_edges = 14  ///< HorizonEdge, cell frame, cell by cell: those that are no side of a triangle
};
inline constexpr std::uint32_t section_count = 12;

struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t section_count;
  std::int32_t block_i, block_j;
  std::uint64_t file_bytes;
  std::array<std::uint8_t, 32> reserved;  ///< zero
};
static_assert(sizeof(Header) == 64);

struct Section {
  SectionKind kind;  ///< a reader skips kinds that it does not know
  std::uint32_t element_bytes;
  std::uint64_t offset;    ///< from the file's beginning
  std::uint64_t count;     ///< elements, not bytes
  std::uint64_t reserved;  ///< zero
};
static_assert(sizeof(Section) == 32);

/// Bits of CellRecord::flags.
inline constexpr std::uint32_t cell_has_overhang = 1;  ///< a surface of the tile looks down onto something below it

/// What a cell owns of `vertices`, `triangles`, `surface_runs`, `tile_edges` and `loose_edges` follows what the cell before owns,
/// without a gap.
struct CellRecord {
  std::int32_t i, j;
  std::uint32_t vertex_count, triangle_count;
  std::array<std::uint32_t, edge_role_count> edge_counts;  ///< rows of `tile_edges`, for each EdgeRole
  std::uint32_t loose_edge_count;                          ///< rows of `loose_edges`
  float z_low_m, z_high_m;                                 ///< of the tile's vertices; low > high when it is empty
  float capture_x_m, capture_y_m, capture_z_m;             ///< where the far map was captured, cell frame
  float far_map_top;                                       ///< BoxMap::top; 0 when the cell has no far field above the horizontal
  std::uint32_t flags;
};
static_assert(sizeof(CellRecord) == 60);

/// An edge of a tile (HorizonEdge), as a side of one of its triangles. The sides of a cell are counted triangle by triangle,
/// three each: from the first corner to the second, on to the third, and back. Each row stores the number of sides to skip before
/// the next edge of its role. The value 255 skips 255 sides and stores no edge. Each role counts from the first side.
struct TileEdge {
  static constexpr std::uint8_t only_passes = 255;
  std::uint8_t sides_passed;
  AdjacentSlopes adjacent;  ///< along the side
  bool operator==(const TileEdge&) const = default;
};
static_assert(sizeof(TileEdge) == 3);

/// Consecutive triangles of a cell that belong to one surface. The runs of a cell cover its triangles: the first begins at
/// triangle 0, each other one where the one before it ends, and the last ends with the cell.
struct SurfaceRun {
  std::uint32_t surface;  ///< row in `surfaces`
  std::uint32_t end;      ///< the first triangle after the run, counted from the cell's first
};
static_assert(sizeof(SurfaceRun) == 8);

inline constexpr std::uint32_t no_building = 0xFFFFFFFF;

/// The bits of kind, grounded and normal follow one another from the lowest on, as compilers for Linux lay them out; a test
/// looks.
struct SurfaceRecord {
  std::uint32_t building;  ///< row in `buildings`; no_building for the ground
  std::uint32_t number;    ///< of the surface, within its building
  std::uint16_t part;      ///< closed part of the building, for the question "inside?"
  SurfaceKind kind : 3;
  std::uint8_t grounded : 1;  ///< 1: nobody outside has its building overhead, and no gap is seen below it
  std::uint64_t normal_u : OctNormal::bits;
  std::uint64_t normal_v : OctNormal::bits;

  /// Outward, grid frame.
  [[nodiscard]] OctNormal normal() const {
    return {static_cast<std::uint32_t>(normal_u), static_cast<std::uint32_t>(normal_v)};
  }
};
static_assert(sizeof(SurfaceRecord) == 16);

struct BuildingRecord {
  std::uint32_t text_offset, text_bytes;
  std::uint32_t number;  ///< of the building, within the city
};
static_assert(sizeof(BuildingRecord) == 12);

static_assert(sizeof(Point3f) == 12 && sizeof(Triangle) == 12);

/// Layers of a far map of the kind `horizon`, at the most.
inline constexpr std::uint32_t most_layers = 8;

/// What a cell's far map names, and the heights of its layers (ReceiverPatches). Levels beyond the last repeat it.
struct FarCellRecord {
  std::uint64_t first_explicit_edge;
  std::uint32_t explicit_edge_count;
  std::array<float, most_layers> levels_m;
  std::uint32_t reserved;  ///< zero
};
static_assert(sizeof(FarCellRecord) == 48);

/// An occluder that receivers in some patches of a cell must meet by itself: in the squares and in the layers whose bits are set.
struct ExplicitOccluder {
  std::uint32_t row;
  std::uint16_t squares;
  std::uint16_t layers;
  [[nodiscard]] bool matters(std::uint32_t square, std::uint32_t layer) const {
    return ((squares >> square) & 1U) != 0 && ((layers >> layer) & 1U) != 0;
  }
};
static_assert(sizeof(ExplicitOccluder) == 8);

static_assert(sizeof(HorizonEdge) == 28 && sizeof(AdjacentSlopes) == 2);

/// The folder of a block within a package, and its two files.
[[nodiscard]] inline std::string block_folder(Block b) { return "blocks/" + std::to_string(b.i) + "_" + std::to_string(b.j); }
inline constexpr const char* tiles_file = "tiles.bin";
inline constexpr const char* far_map_file = "far.exr";
inline constexpr const char* manifest_file = "manifest.json";

/// Channels of far.exr, all half. Of the kind `box`: Y is 1 where the sky is seen and 0 where the far city hides it, so that any
/// viewer shows the map; Z is the distance in metres from the capture point to what hides the sky, infinite where nothing does.
/// Of the kind `horizon`: slopes (tangents of elevations) of the residual city, a column for each azimuth bin, a row for each
/// patch from the first; `low`, `high` and `overhang` are certain all over the patch, Y is what is likely on the floor of the
/// patch.
inline constexpr const char* sky_channel = "Y";
inline constexpr const char* distance_channel = "Z";
inline constexpr const char* estimate_channel = "Y";
inline constexpr const char* low_channel = "low";
inline constexpr const char* high_channel = "high";
inline constexpr const char* overhang_channel = "overhang";

}  // namespace farlod::package
