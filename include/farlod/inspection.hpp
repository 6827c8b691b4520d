// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/run.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod {

/// A cell of the grid: i counts to the east, j to the north, in the frame that is turned along the streets.
struct CellPlace {
  std::int32_t i = 0, j = 0;
  auto operator<=>(const CellPlace&) const = default;
};

/// A rectangle of cells, half open: i_begin ≤ i < i_end.
struct CellRectangle {
  std::int32_t i_begin = 0, j_begin = 0, i_end = 0, j_end = 0;
  bool operator==(const CellRectangle&) const = default;

  [[nodiscard]] constexpr bool contains(CellPlace c) const {
    return i_begin <= c.i && c.i < i_end && j_begin <= c.j && c.j < j_end;
  }
};

/// A file that was packed.
struct PackedInput {
  std::string name;         ///< without its folder
  std::uint64_t bytes = 0;  ///< of the file
  std::uint64_t xxh3 = 0;   ///< XXH3-64 of the file, seed 0
};

/// The trees of a package: how many crowns there are of each shape.
struct PackedCrowns {
  std::uint64_t spheroids = 0, cylinders = 0, prisms = 0;
  std::uint64_t bytes = 0;  ///< on disk

  [[nodiscard]] constexpr std::uint64_t all() const { return spheroids + cylinders + prisms; }
};

/// What a manifest says besides PackageDescription.
struct PackageInventory {
  std::uint32_t format_version = 0;
  Point2d origin_m;              ///< of the city frame, in the package's CRS
  double height_origin_m = 0.0;  ///< heights on disk count from here
  CellRectangle cells;           ///< that exist
  int block_edge = 0;            ///< cells along the edge of a block
  std::uint64_t blocks = 0;
  std::string assign;  ///< "clip" or "whole"
  /// Sizes of far maps of the kind "horizon"; zero for the other kind.
  std::uint32_t azimuth_bins = 0, squares_per_edge = 0, layers = 0;
  double tolerance = 0.0;
  /// Sizes of far maps of the kind "box"; zero for the other kind.
  std::uint32_t side_columns = 0, rows = 0;
  std::uint64_t tile_bytes = 0, far_map_bytes = 0;  ///< on disk
  PackedCrowns crowns;
  std::vector<PackedInput> inputs;
  std::vector<std::pair<int, std::uint64_t>> problems;  ///< how often each ProblemCode was met, ascending
};

/// Throws InvalidArgument when the package is closed.
[[nodiscard]] FARLOD_EXPORT PackageInventory inventory_of(const Package& package);

/// The heights of all geometry, above sea level.
struct HeightRange {
  double low_m = 0.0, high_m = 0.0;
};

/// Empty where there is no geometry. It reads what a package says of its cells, and no geometry, so that it takes a moment even
/// of a large package, and a checksum that is wrong is not noticed. Throws InvalidArgument when the package is closed,
/// PackageDamaged.
[[nodiscard]] FARLOD_EXPORT std::optional<HeightRange> heights_of(const Package& package);

/// Something in a package that is not what it should be.
struct PackageDamage {
  std::string file;               ///< within the folder of the package
  std::optional<CellPlace> cell;  ///< where a single cell is concerned
  std::string what;               ///< a sentence that names the file and the first rule that it breaks
};

/// What came of reading a whole package.
struct PackageCheck {
  std::uint64_t files = 0, bytes = 0;     ///< of all files that the manifest lists
  std::uint64_t cells = 0, far_maps = 0;  ///< tiles and far maps that were read from end to end, and are right
  std::uint64_t crowns = 0;               ///< the same of crowns
  std::vector<PackageDamage> damage;      ///< in the order of the blocks, and within a block by file and cell; then others
};

/// Reads all of a package: each file is compared with its checksum, each tile is checked, and each far map is decoded. What is
/// wrong is collected, and ends nothing. Throws InvalidArgument, Cancelled, LimitReached.
[[nodiscard]] FARLOD_EXPORT PackageCheck check_package(const Package& package, const RunSettings& run = {});

/// A cell of a neighborhood.
struct NeighborCell {
  CellPlace cell;
  std::uint64_t triangles = 0;
};

/// What a package holds of one cell.
struct CellContents {
  CellPlace cell;
  std::array<Point2d, 4> corners_projected;  ///< from the south-west corner of the grid frame, counter-clockwise
  std::uint64_t vertices = 0, triangles = 0, buildings = 0;
  /// Edges that can be silhouettes: upper borders of what stands, upper and lower borders of what overhangs.
  std::uint64_t grounded_edges = 0, overhang_edges = 0, underside_edges = 0;
  std::optional<double> low_m, high_m;  ///< of its vertices, above sea level
  std::uint64_t tile_bytes = 0;         ///< of what only this cell owns
  bool has_far_map = false;
  std::uint64_t far_map_bytes = 0;       ///< of its picture as it lies on disk, compressed
  std::uint64_t explicit_edges = 0;      ///< far edges that are drawn from where a receiver stands; kind "horizon"
  CellRectangle neighborhood;            ///< N × N cells, some of which may lie outside of the grid
  std::vector<NeighborCell> near_cells;  ///< those that exist, row by row from the south-west
};

/// Throws InvalidArgument where there is no such cell, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT CellContents inspect_cell(const Package& package, CellPlace cell);

/// A triangle by three vertices of its part, counter-clockwise as its outward normal says.
struct MeshTriangle {
  std::array<std::uint32_t, 3> vertices{};
  SurfaceKind kind = SurfaceKind::unknown;
  std::uint32_t surface = 0;  ///< its number within the building, as SurfaceMean has it; of the ground, no promise
};

/// What one cell owns of one building, or of the ground.
struct MeshPart {
  CellPlace cell;
  std::optional<std::uint32_t> building;  ///< its number within the city; none for the ground
  std::string id;                         ///< of the building
  std::vector<Point3d> vertices_projected;
  std::vector<MeshTriangle> triangles;
};

/// The geometry of the cells of a rectangle that exist: the ground first, then building by building, each cell by cell. Throws
/// InvalidArgument where the rectangle has more than 10,000 cells or no width, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT std::vector<MeshPart> geometry_of(const Package& package, const CellRectangle& cells);

/// A polygon in space, whose rings do not repeat their first corner: the shell runs counter-clockwise about its normal, holes run
/// the other way.
struct SurfacePolygon {
  std::vector<Point3d> shell;
  std::vector<std::vector<Point3d>> holes;
};

/// What the triangles of one surface cover, of however many cells they come, as outlines: a polygon for each piece that is not
/// connected with the others. Corners within a millimetre of each other are one, and what is not a millimetre wide is left out.
/// Where triangles lie on each other, or not in a plane, or are all so narrow, each is a polygon.
[[nodiscard]] FARLOD_EXPORT std::vector<SurfacePolygon> polygons_of(std::span<const std::array<Point3d, 3>> triangles);

/// A far edge that a far map stores by itself.
struct FarEdge {
  Point3d a_projected, b_projected;
};

/// A far map of the kind "horizon", seen from one place: tangents of elevations, clockwise from `first_azimuth` in equal bins.
struct FarHorizonView {
  Angle first_azimuth;  ///< true azimuth where bin 0 begins
  /// The residual city hides everything below `low` (but what is seen below an overhang), and nothing above `high`.
  std::vector<float> low, estimate, high;
  std::vector<FarEdge> edges;  ///< that count besides
};

/// A far map of the kind "box", as it was captured: the four walls of a box around the capture point, clockwise, first the one
/// to the north of the grid frame.
struct FarBoxView {
  Angle north_azimuth;  ///< true azimuth of the middle of the first wall
  std::size_t side_columns = 0, rows = 0;
  double top = 0.0;               ///< tangent of the elevation of the upper edge in the middle of a wall
  std::vector<float> distance_m;  ///< row by row from the horizontal upwards, each clockwise; infinite where sky is seen
};

/// What the far map of a cell says to an observer in the middle of the cell. One of the views has bins or texels.
struct FarView {
  Point3d eye_projected;  ///< 1.5 m above the ground, or where the map was captured
  FarHorizonView horizon;
  FarBoxView box;
};

/// Empty where the cell has no far map. Throws InvalidArgument where there is no such cell, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT std::optional<FarView> far_view_of(const Package& package, CellPlace cell);

}  // namespace farlod
