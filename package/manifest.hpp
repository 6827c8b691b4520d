// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/grid.hpp"
#include "farlod/angle.hpp"
#include "farlod/box.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "package/crown.hpp"
#include "package/layout.hpp"
#include "package/package_folder.hpp"

namespace farlod::package {

/// Consecutive cells of a block, by their places in CellRange::index_of; half open.
struct CellRun {
  std::uint32_t begin = 0, end = 0;
  bool operator==(const CellRun&) const = default;
};

/// Some of a block's cells. The runs ascend, and are neither empty nor adjacent, so that a set of cells has one form.
struct CellRuns {
  std::vector<CellRun> runs;
  bool operator==(const CellRuns&) const = default;

  /// The runs of places that ascend.
  [[nodiscard]] static CellRuns of(std::span<const std::size_t> places) {
    CellRuns result;
    for (const std::size_t place : places) {
      const auto n = static_cast<std::uint32_t>(place);
      if (!result.runs.empty() && result.runs.back().end == n) {
        ++result.runs.back().end;
      } else {
        result.runs.push_back({n, n + 1});
      }
    }
    return result;
  }
  [[nodiscard]] std::size_t size() const {
    std::size_t count = 0;
    for (const CellRun& run : runs) count += run.end - run.begin;
    return count;
  }
  [[nodiscard]] bool contains(std::size_t place) const {
    const auto after =
        std::upper_bound(runs.begin(), runs.end(), place, [](std::size_t p, const CellRun& r) { return p < r.begin; });
    return after != runs.begin() && place < (after - 1)->end;
  }
  /// How many of the cells come before a place.
  [[nodiscard]] std::size_t count_before(std::size_t place) const {
    std::size_t count = 0;
    for (const CellRun& run : runs) {
      if (place <= run.begin) break;
      count += std::min<std::size_t>(place, run.end) - run.begin;
    }
    return count;
  }
  [[nodiscard]] std::vector<std::size_t> places() const {
    std::vector<std::size_t> result;
    for (const CellRun& run : runs)
      for (std::size_t place = run.begin; place < run.end; ++place) result.push_back(place);
    return result;
  }
};

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

/// The pixels of the raster that a city is: squares, north up in the output CRS.
struct SurfacePixels {
  Point2d north_west_m;  ///< outer corner of the first pixel
  double step_m = 0.0;   ///< edge of a pixel
  std::uint32_t columns = 0, rows = 0;
  std::optional<FileStamp> heights = {};    ///< of `heights.bin`, where the surface is made of these pixels
  std::optional<std::uint64_t> walls = {};  ///< sides between two heights that walls stand on, where they were counted
  /// Squares between four pixels whose triangles are in no tiles file, since readers make them (ReliefTiles); absent without.
  std::optional<std::uint64_t> squares = {};
};

/// A box and the ground around it that maps show: 50 m, or a thirtieth of the side where that is less, so that the box of a small
/// town fills the map, too. A single house has 5 m around it.
[[nodiscard]] inline Box2d with_margin(const Box2d& box) {
  constexpr double least_m = 5.0, most_m = 50.0, share_of_side = 1.0 / 30.0;
  const auto margin_m = [&](double side_m) { return std::clamp(share_of_side * side_m, least_m, most_m); };
  const Point2d margin{margin_m(box.high.x - box.low.x), margin_m(box.high.y - box.low.y)};
  return {box.low - margin, box.high + margin};
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
  std::optional<Box2d> buildings_projected = {};              ///< around all points of the buildings, where there are any
  std::vector<std::pair<int, std::uint64_t>> problem_counts;  ///< by code, ascending
  std::vector<BlockFiles> blocks;                             ///< in the order of Grid::blocks()
  std::optional<CanopyFile> canopy = {};                      ///< where there are crowns
  std::optional<FileStamp> sources = {};                      ///< of `sources.bin`, where city files have places for attributes
  std::optional<SurfacePixels> pixels = {};                   ///< where the city is a raster
  std::optional<FileStamp> far_terrain = {};                  ///< of `far_terrain.bin`, where the ground beyond the grid is known

  /// The stamp of `heights.bin`.
  [[nodiscard]] std::optional<FileStamp> heights() const { return pixels ? pixels->heights : std::nullopt; }
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
  /// Where the city is, for whoever says no part of it: the pixels of its raster; else its buildings, with_margin; else, of a
  /// bare terrain and of packages that do not tell their buildings' box, all cells.
  [[nodiscard]] Box2d city_projected() const {
    if (pixels) {
      const Point2d corner = pixels->north_west_m;
      return {{corner.x, corner.y - pixels->rows * pixels->step_m}, {corner.x + pixels->columns * pixels->step_m, corner.y}};
    }
    return buildings_projected ? with_margin(*buildings_projected) : projected_outline(grid.rectangle());
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

namespace farlod {

/// The largest index of a cell in a package: beyond it, multiples of the cell edge are no longer exact (exact_cell_edge_m).
inline constexpr std::int32_t farthest_cell_index = std::int32_t{1} << 29;

/// XXH3-64 with seed 0: what a manifest says at its end of the text before (package::ManifestSeal).
[[nodiscard]] std::uint64_t checksum_of_manifest(std::string_view sealed);

/// Checks the text of a manifest; `name` is for messages. What it takes in memory is at most 64 times the text.
/// Throws PackageUnusable (another version of the format) or PackageDamaged (its checksum is not that of its text, a key is
/// missing or impossible).
[[nodiscard]] package::Manifest manifest_from_text(std::string_view text, const std::string& name);

/// Reads and checks `manifest.json` of a package's folder.
/// Throws PackageUnusable (no package there, another version of the format) or PackageDamaged.
[[nodiscard]] package::Manifest read_manifest(const PackageFolder& package_folder);
[[nodiscard]] package::Manifest read_manifest(const std::filesystem::path& package_folder);

/// The text of `manifest.json`, in the version of the format that its contents need, with its checksum at the end.
/// docs/package_format.md lists the keys.
[[nodiscard]] std::string manifest_text(const package::Manifest& manifest);

}  // namespace farlod

namespace farlod::package {

/// The end of a manifest that has a checksum of itself: the key `xxh3`, the last one of the manifest, in exactly these bytes. It
/// is the same in each version of the format that has one, so that damage is told from another version.
struct ManifestSeal {
  static constexpr std::string_view before_digits = "\"xxh3\": \"", after_digits = "\"\n}\n";
  static constexpr std::size_t digits = 16;
  static constexpr std::size_t bytes = before_digits.size() + digits + after_digits.size();

  std::string_view sealed;     ///< all bytes of the manifest before the seal
  std::uint64_t checksum = 0;  ///< their XXH3-64 with seed 0

  /// The seal of a manifest; none where its last bytes are not one. Digits are lower case, so that no bit can change unnoticed.
  [[nodiscard]] static std::optional<ManifestSeal> of(std::string_view manifest) {
    if (manifest.size() < bytes) return std::nullopt;
    const std::string_view end = manifest.substr(manifest.size() - bytes);
    const std::string_view number = end.substr(before_digits.size(), digits);
    const bool is_seal = end.starts_with(before_digits) && end.ends_with(after_digits) &&
                         number.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    if (!is_seal) return std::nullopt;
    ManifestSeal seal{manifest.substr(0, manifest.size() - bytes), 0};
    std::from_chars(number.data(), number.data() + number.size(), seal.checksum, 16);
    return seal;
  }

  /// The bytes that end a manifest whose other bytes have this checksum.
  [[nodiscard]] static std::string text_of(std::uint64_t checksum) {
    std::string number(digits, '0');
    for (std::size_t n = digits; n > 0; --n, checksum >>= 4U) number[n - 1] = "0123456789abcdef"[checksum & 15U];
    return std::string(before_digits) + number + std::string(after_digits);
  }
};

/// The version of the format that a package needs.
[[nodiscard]] inline std::uint32_t version_of(const Manifest& m) {
  if (m.pixels && m.pixels->squares) return relief_format_version;
  return m.far_terrain ? far_terrain_format_version : format_version;
}

/// Whether a package is of a surface, pixel for pixel, and of nothing else, and most pixels differ from their neighbors: natural
/// relief, and what lasers have surveyed. Rays march over its pixels sooner than edges are drawn
/// (docs/decisions/0032-a-march-over-pixels.md), and its cells need no far maps.
[[nodiscard]] bool has_rough_surface(const Manifest& manifest);

/// What users are told of a package.
[[nodiscard]] inline PackageDescription described(const Manifest& m) {
  PackageDescription d;
  d.software = m.software;
  d.crs_wkt = m.crs_wkt;
  d.crs_name = m.crs_name;
  d.epsg = m.epsg;
  d.outline_projected = m.projected_outline(m.grid.rectangle());
  d.city_projected = m.city_projected();
  d.buildings_projected = m.buildings_projected;
  d.grid_bearing = m.grid.rotation.bearing();
  d.convergence = m.convergence;
  d.cell_edge_m = m.grid.cell_edge_m;
  d.neighborhood = m.grid.neighborhood;
  d.columns = m.grid.cells.width();
  d.rows = m.grid.cells.height();
  d.far_map_kind = m.far_map.kind;
  d.cells_with_far_map = m.cells_with_far_map();
  d.buildings = m.buildings;
  d.polygons = m.polygons;
  d.triangles = m.triangles;
  d.manifest_xxh3 = m.file_xxh3;
  d.has_rough_surface = has_rough_surface(m);
  return d;
}

}  // namespace farlod::package
