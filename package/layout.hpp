// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "base/grid.hpp"
#include "base/mesh_view.hpp"
#include "farlod/point.hpp"
#include "farlod/surface_kind.hpp"
#include "package/horizon_edge.hpp"

namespace farlod::package {

/// A direction in 44 bits: where it meets the octahedron |x| + |y| + |z| = 1, whose lower half is folded outwards, so that both
/// halves together fill the square of the x and y from −1 to 1. Any two numbers of 22 bits are a direction. The six directions
/// along the axes come back exactly, horizontal ones exactly horizontal; what looks up never comes back looking down.
struct OctNormal {
  static constexpr std::uint32_t bits = 22;
  static constexpr std::uint32_t largest = (1U << bits) - 1;
  /// Number of steps of u and v on either side of the middle.
  static constexpr std::int32_t steps = largest / 2;
  /// Between a direction and what comes back: half a diagonal of a step of u and v, which is up to √3 times as long on the
  /// octahedron, whose faces are tilted, and again as far seen from its centre, which is 1/√3 away.
  static constexpr double largest_error_rad = 3.0 * 0.5 * std::numbers::sqrt2 / steps;

  std::uint32_t u = steps, v = steps;  ///< 0 to 2 · steps
  bool operator==(const OctNormal&) const = default;

  /// Nearest to a direction of any length; upwards, where there is none.
  [[nodiscard]] static OctNormal nearest_to(const Point3d& direction) {
    const double size = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(size > 0.0)) return {};
    double u = direction.x / size, v = direction.y / size;
    if (direction.z < 0.0) {
      const double folded = std::copysign(1.0 - std::abs(v), u);
      v = std::copysign(1.0 - std::abs(u), v);
      u = folded;
    }
    return nearest_corner(steps * u, steps * v, direction);
  }

  /// The direction, of length 1.
  [[nodiscard]] Point3f direction() const {
    const Point3d d = normalized(on_octahedron());
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  }
  /// Whether `direction().z` is positive.
  [[nodiscard]] bool looks_up() const { return std::abs(from_middle(u)) + std::abs(from_middle(v)) < steps; }

 private:
  [[nodiscard]] static std::int32_t from_middle(std::uint32_t u_or_v) { return static_cast<std::int32_t>(u_or_v) - steps; }

  /// In steps.
  [[nodiscard]] Point3d on_octahedron() const {
    const double x = from_middle(u), y = from_middle(v), z = steps - std::abs(x) - std::abs(y);
    if (z >= 0.0) return {x, y, z};
    return {x < 0.0 ? std::abs(y) - steps : steps - std::abs(y), y < 0.0 ? std::abs(x) - steps : steps - std::abs(x), z};
  }

  /// The corners around a place fold differently: which one is the nearest shows only on the sphere.
  [[nodiscard]] static OctNormal nearest_corner(double u_steps, double v_steps, const Point3d& direction) {
    OctNormal nearest;
    double most_alike = -std::numeric_limits<double>::infinity();
    for (const double u : {std::floor(u_steps), std::ceil(u_steps)})
      for (const double v : {std::floor(v_steps), std::ceil(v_steps)}) {
        const OctNormal corner{static_cast<std::uint32_t>(u + steps), static_cast<std::uint32_t>(v + steps)};
        const double alike = dot(normalized(corner.on_octahedron()), direction);
        if (alike <= most_alike) continue;
        most_alike = alike;
        nearest = corner;
      }
    return nearest;
  }
};

/// The bytes of `tiles.bin`. docs/package_format.md tells the same in words; where they differ, this file wins.
/// All numbers are little-endian. Sections start at multiples of 64 bytes, and the file ends with 16 bytes of padding, so
/// that a section can be a vertex buffer whose last vertex is read as 16 bytes.

static_assert(std::endian::native == std::endian::little,
              "packages are mapped, not decoded: a big-endian reader must swap bytes");

/// The version of the manifest, and so of the package, that is written: trees (crown.hpp) and the places that surfaces
/// come from (sources_layout.hpp) are there where the city has them.
inline constexpr std::uint32_t format_version = 10;
/// The version of a package that knows the ground beyond its grid (far_terrain.hpp): who does not read that would miss mountains.
inline constexpr std::uint32_t far_terrain_format_version = 11;
/// The version of a rough surface whose tiles are partly in heights.bin (pixel_heights.hpp): who does not read that would miss
/// most of it. It may know the ground beyond its grid.
inline constexpr std::uint32_t relief_format_version = 12;
/// The version of a city with trees, before version 10.
inline constexpr std::uint32_t canopy_format_version = 9;
/// The newest one that is read.
inline constexpr std::uint32_t newest_format_version = relief_format_version;
/// The oldest one that is read.
inline constexpr std::uint32_t oldest_format_version = 8;
/// The version of `tiles.bin`, which changes on its own.
inline constexpr std::uint32_t tiles_version = 6;
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
  far_cells = 8,        ///< FarCellRecord, as many and in the same order as `cells`
  far_edges = 9,        ///< HorizonEdge, block frame: the explicit occluders of the cells' far maps
  explicit_edges = 11,  ///< ExplicitOccluder: rows of `far_edges`, cell by cell
  // The tiles again
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
  std::uint32_t flags;  ///< zero; bit 0 is taken: packages of earlier releases set it where the tile holds a lower border
};
static_assert(sizeof(CellRecord) == 60);

/// An edge of a tile (HorizonEdge), as a side of one of its triangles. The sides of a cell are numbered triangle by triangle,
/// three each: from corner a to b, from b to c, from c to a. Each entry stores the number of sides to skip before the next edge
/// of its role. The value 255 skips 255 sides and stores no edge. Each role counts from side 0.
struct TileEdge {
  static constexpr std::uint8_t skip_only = 255;
  std::uint8_t sides_skipped;
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

/// A surface. Its last six bytes are one number of 48 bits: kind, grounded and normal, packed from the lowest bit on.
struct SurfaceRecord {
  std::uint32_t building;               ///< row in `buildings`; no_building for the ground
  std::uint32_t number;                 ///< of the surface, within its building
  std::uint16_t part;                   ///< closed part of the building, for the question "inside?"
  std::array<std::uint16_t, 3> packed;  ///< the number of 48 bits, its lowest 16 first

  [[nodiscard]] SurfaceKind kind() const { return static_cast<SurfaceKind>(unpacked(kind_shift, kind_bits)); }
  /// Nobody outside has the surface overhead, and it hides nothing above the grounded horizon.
  [[nodiscard]] bool is_grounded() const { return unpacked(grounded_shift, 1) != 0; }
  /// Outward, grid frame.
  [[nodiscard]] OctNormal normal() const {
    return {unpacked(normal_u_shift, OctNormal::bits), unpacked(normal_v_shift, OctNormal::bits)};
  }
  void pack(SurfaceKind kind, bool is_grounded, OctNormal normal) {
    const std::uint64_t all = (std::uint64_t{static_cast<std::uint8_t>(kind)} << kind_shift) |
                              (std::uint64_t{is_grounded ? 1U : 0U} << grounded_shift) |
                              (std::uint64_t{normal.u} << normal_u_shift) | (std::uint64_t{normal.v} << normal_v_shift);
    for (std::size_t word = 0; word < packed.size(); ++word) packed[word] = static_cast<std::uint16_t>(all >> (16 * word));
  }

 private:
  static constexpr std::uint32_t kind_shift = 0, kind_bits = 3, grounded_shift = 3, normal_u_shift = 4,
                                 normal_v_shift = normal_u_shift + OctNormal::bits;
  static_assert(normal_v_shift + OctNormal::bits == 48);

  [[nodiscard]] std::uint32_t unpacked(std::uint32_t shift, std::uint32_t bits) const {
    const std::uint64_t all = packed[0] | (std::uint64_t{packed[1]} << 16U) | (std::uint64_t{packed[2]} << 32U);
    return static_cast<std::uint32_t>((all >> shift) & ((std::uint64_t{1} << bits) - 1));
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

/// The explicit occluders of a cell's far map, and the heights of its layers (ReceiverPatches). Levels beyond the last repeat it.
struct FarCellRecord {
  std::uint64_t first_explicit_edge;
  std::uint32_t explicit_edge_count;
  std::array<float, most_layers> levels_m;
  std::uint32_t reserved;  ///< zero
};
static_assert(sizeof(FarCellRecord) == 48);

/// An occluder that is drawn from where each receiver stands, in some patches of a cell: those in the squares and in the layers
/// whose bits are set.
struct ExplicitOccluder {
  std::uint32_t row;
  std::uint16_t squares;
  std::uint16_t layers;
};
static_assert(sizeof(ExplicitOccluder) == 8);

static_assert(sizeof(HorizonEdge) == 28 && sizeof(AdjacentSlopes) == 2);

/// No city reaches farther from one of its cells than the Earth is wide. What does would be lost on the way to the ray index,
/// which takes no triangle beyond 1.8e18 and says nothing.
inline constexpr float farthest_in_tile_m = 1.3e7F;
/// False for what is not a number, too.
[[nodiscard]] inline bool is_on_earth(const Point3f& p) {
  return std::abs(p.x) <= farthest_in_tile_m && std::abs(p.y) <= farthest_in_tile_m && std::abs(p.z) <= farthest_in_tile_m;
}

/// The folder of a block each of whose cells has a far map (folder_of), and its two files.
[[nodiscard]] inline std::string block_folder(Block b) { return "blocks/" + std::to_string(b.i) + "_" + std::to_string(b.j); }
inline constexpr const char* tiles_file = "tiles.bin";
inline constexpr const char* far_map_file = "far.exr";
inline constexpr const char* manifest_file = "manifest.json";
inline constexpr const char* heights_file = "heights.bin";          ///< in the folder of the package
inline constexpr const char* far_terrain_file = "far_terrain.bin";  ///< in the folder of the package

// Channels of far.exr, all half. Either kind has a channel Y, which any viewer shows as a grey picture.
//
// The kind `box` has:
inline constexpr const char* sky_channel = "Y";       ///< 1 where the sky is seen, 0 where the far city hides it
inline constexpr const char* distance_channel = "Z";  ///< metres from the capture point to what hides the sky; infinite for sky
// The kind `horizon` has slopes (tangents of elevations) of the residual city; a column for each azimuth bin, a row for each
// patch from the first. Three are bounds all over the patch, and Y is an estimate on the floor of the patch.
inline constexpr const char* estimate_channel = "Y";
inline constexpr const char* low_channel = "low";
inline constexpr const char* high_channel = "high";
inline constexpr const char* overhang_channel = "overhang";

}  // namespace farlod::package
