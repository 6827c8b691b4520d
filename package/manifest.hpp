// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/grid.hpp"
#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/point.hpp"
#include "package/cell_runs.hpp"
#include "package/crown.hpp"
#include "package/layout.hpp"

namespace farlod::package {

/// Size and XXH3-64 checksum of a file, as found when it was written.
struct FileStamp {
  std::uint64_t bytes = 0;
  std::uint64_t xxh3 = 0;
  bool operator==(const FileStamp&) const = default;
};

struct InputFile {
  std::string name;
  FileStamp stamp;
};

struct BlockFiles {
  Block block;
  FileStamp tiles, far_map;
  /// The cells that have far maps, where not all have one. Where none has, there is no file of far maps.
  std::optional<CellRuns> mapped = {};

  /// Whether the cell at this place in CellRange::index_of has a far map.
  [[nodiscard]] bool has_far_map(std::size_t place) const { return !mapped || mapped->contains(place); }
  [[nodiscard]] bool has_far_maps() const { return !mapped || !mapped->runs.empty(); }
};

/// The folder of a block within a package. A block of which n cells have far maps, and not all, has a name with n: when far maps
/// are added, the new files stand beside the old ones until the manifest names them.
[[nodiscard]] inline std::string folder_of(const BlockFiles& files) {
  return block_folder(files.block) + (files.mapped ? "_" + std::to_string(files.mapped->size()) : "");
}

/// The keys of a manifest that count the crowns of each CrownShape.
inline constexpr std::array<const char*, crown_shape_count> crown_shape_keys{"spheroids", "cylinders", "prisms"};

/// The crowns of a package, in `crowns.bin`.
struct CanopyFile {
  FileStamp stamp;
  std::array<std::uint64_t, crown_shape_count> crowns_of_shape{};  ///< by CrownShape

  [[nodiscard]] std::uint64_t crowns() const {
    return std::accumulate(crowns_of_shape.begin(), crowns_of_shape.end(), std::uint64_t{0});
  }
  bool operator==(const CanopyFile&) const = default;
};

/// The kind of a package's far maps, and the size of their pictures.
struct FarMapShape {
  std::string kind;                                                  ///< "horizon" or "box"
  std::uint32_t side_columns = 0, rows = 0;                          ///< of the kind `box`
  std::uint32_t azimuth_bins = 0, squares_per_edge = 0, layers = 0;  ///< of the kind `horizon`
  double tolerance = 0.0;                                            ///< of the kind `horizon`: see docs/stages/farmap.md

  [[nodiscard]] bool is_box() const { return kind == "box"; }
  /// Pixels of one cell's picture.
  [[nodiscard]] std::uint32_t picture_columns() const { return is_box() ? 4 * side_columns : azimuth_bins; }
  [[nodiscard]] std::uint32_t picture_rows() const { return is_box() ? rows : squares_per_edge * squares_per_edge * layers; }
};

/// How many tiles the picture of a block's `far.exr` has, along either axis.
struct PictureTiles {
  std::int64_t columns = 0, rows = 0;
};
/// The tile of a cell in that picture.
struct PictureTile {
  std::int32_t column = 0, row = 0;
};

/// Where all cells have far maps, tiles lie as cells do; where some have, theirs lie in one column, in the order of
/// CellRange::index_of, so that no tile is empty.
[[nodiscard]] inline PictureTiles picture_tiles(const CellRange& cells, const std::optional<CellRuns>& mapped) {
  if (!mapped) return {cells.width(), cells.height()};
  return {1, static_cast<std::int64_t>(mapped->size())};
}
/// The cell must have a far map.
[[nodiscard]] inline PictureTile picture_tile(Cell cell, const CellRange& cells, const std::optional<CellRuns>& mapped) {
  if (!mapped) return {cell.i - cells.i_begin, cell.j - cells.j_begin};
  return {0, static_cast<std::int32_t>(mapped->count_before(cells.index_of(cell)))};
}

/// What `manifest.json` says. docs/package_format.md lists the keys.
struct Manifest {
  std::uint32_t version = format_version;  ///< of the format, as read; what is written has format_version
  std::uint64_t file_xxh3 = 0;             ///< XXH3-64 of the whole file, once it was read or written
  std::string software;
  std::string crs_wkt, crs_name;
  std::optional<int> epsg;
  Point2d origin_m;            ///< of the city frame, in the output CRS
  double height_origin_m = 0;  ///< heights on disk count from here
  Angle convergence;           ///< true azimuth = grid azimuth + convergence
  Grid grid;
  std::string assign;  ///< "clip" or "whole"
  FarMapShape far_map;
  std::vector<InputFile> inputs;
  std::uint64_t buildings = 0, polygons = 0, triangles = 0;
  std::vector<std::pair<int, std::uint64_t>> problem_counts;  ///< by code, ascending
  std::vector<BlockFiles> blocks;                             ///< in the order of Grid::blocks()
  std::optional<CanopyFile> canopy = {};                      ///< where there are crowns
  std::optional<FileStamp> sources = {};                      ///< of `sources.bin`, where city files have places for attributes

  /// Whether each cell has a far map.
  [[nodiscard]] bool is_fully_mapped() const {
    return std::none_of(blocks.begin(), blocks.end(), [](const BlockFiles& b) { return b.mapped.has_value(); });
  }
  [[nodiscard]] std::uint64_t cells_with_far_map() const {
    std::uint64_t count = 0;
    for (const BlockFiles& b : blocks)
      count += b.mapped ? b.mapped->size() : static_cast<std::uint64_t>(grid.cells_of(b.block).size());
    return count;
  }
  /// Between the grid frame and the output CRS; heights are the same in both.
  [[nodiscard]] Point3d projected_from_grid(const Point3d& p_grid) const {
    const Point2d p = origin_m + grid.rotation.city_from_grid(horizontal(p_grid));
    return {p.x, p.y, p_grid.z};
  }
  /// Around a rectangle of the grid frame.
  [[nodiscard]] Box2d projected_outline(const Box2d& rectangle_grid) const {
    const auto& [low, high] = rectangle_grid;
    Box2d outline;
    for (const Point2d corner : {low, Point2d{high.x, low.y}, high, Point2d{low.x, high.y}})
      outline.add(horizontal(projected_from_grid({corner.x, corner.y, 0.0})));
    return outline;
  }
  [[nodiscard]] Point2d grid_from_projected(Point2d p_projected) const {
    return grid.rotation.grid_from_city(p_projected - origin_m);
  }
};

}  // namespace farlod::package
