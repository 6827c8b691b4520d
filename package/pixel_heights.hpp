// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// Which pixels beside one the surface goes on to without a step. Both have a height.
struct JoinedPixels {
  static constexpr std::uint8_t east = 1, north = 2;
};

/// What the byte of a pixel says beside JoinedPixels, of the square between its centre and those of the next pixels to the east,
/// to the north, and to both.
struct PixelSquares {
  static constexpr std::uint8_t left_out = 4;     ///< its two triangles are in no file: ReliefTiles makes them
  static constexpr std::uint8_t folds_aside = 8;  ///< they meet between the pixel to the east and that to the north
};

/// Where the centres of a raster's pixels lie: each reader and writer computes the same bits from it.
struct PixelsInGrid {
  double first_x_m, first_y_m;  ///< of the south-western pixel, city frame
  double step_m;
  double cos, sin;  ///< of the bearing of the grid's y axis

  [[nodiscard]] Point2d centre_of(std::size_t column, std::size_t row) const {
    const Point2d p_city{first_x_m + static_cast<double>(column) * step_m, first_y_m + static_cast<double>(row) * step_m};
    return {cos * p_city.x - sin * p_city.y, sin * p_city.x + cos * p_city.y};
  }
  /// The cell of the grid within which the centre of a pixel lies, on no border of it; nothing where there is none.
  [[nodiscard]] std::optional<Cell> cell_around(std::size_t column, std::size_t row, const Grid& grid) const;
};
static_assert(sizeof(PixelsInGrid) == 40);

/// The surface of a raster that a city is, pixel by pixel: row by row from the south, each row from the west.
struct PixelHeights {
  std::vector<float> height_m;               ///< at the centres of the pixels, as in tiles; NaN where there is none
  std::vector<std::uint8_t> joined;          ///< JoinedPixels and PixelSquares of each; a wall stands on its other sides
  std::optional<PixelsInGrid> in_grid = {};  ///< where squares are left out
};

namespace package {

/// Whether a surface of so many triangles is rough: has_rough_surface.
[[nodiscard]] bool is_rough(const SurfacePixels& pixels, std::uint64_t triangles);

/// The bytes of `heights.bin`, which packages have whose manifest names it, and no others: a header, a float for each pixel and a
/// byte for each pixel. docs/package_format.md tells the same in words; where they differ, this file wins.
inline constexpr std::uint32_t heights_version = 1;
/// A file of this version knows where its pixels lie, since tiles are made of them: PixelsInGrid follows the header.
inline constexpr std::uint32_t placed_heights_version = 2;
inline constexpr std::array<char, 8> heights_magic{'F', 'A', 'R', 'L', 'O', 'D', 'H', '\n'};

struct HeightsHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t columns, rows;
  std::uint32_t reserved;  ///< zero, to be ignored
  std::uint64_t file_bytes;
};
static_assert(sizeof(HeightsHeader) == 32);

}  // namespace package

/// The `heights.bin` of a package, mapped. All is checked once: heights lie on Earth, pixels are joined with such that have a
/// height, and each square that is left out lies within one cell of the grid, as many as the manifest counts.
class PixelHeightsFile {
 public:
  /// Opens that of a package whose manifest names it. Throws PackageDamaged or PackageUnusable.
  PixelHeightsFile(const PackageFolder& folder, const package::Manifest& manifest);

  [[nodiscard]] std::span<const float> height_m() const { return height_m_; }
  [[nodiscard]] std::span<const std::uint8_t> joined() const { return joined_; }
  /// Where squares are left out.
  [[nodiscard]] const std::optional<PixelsInGrid>& in_grid() const { return in_grid_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Gives the memory back. It stays readable, and comes back from the file when somebody reads it.
  void let_go() const { file_.let_go(); }

 private:
  void require(bool rule, const char* what) const { require_whole(rule, name_, what); }
  void read_places(std::uint32_t version, const package::SurfacePixels& pixels);
  void check_pixels(const package::SurfacePixels& pixels) const;
  void check_squares(const package::SurfacePixels& pixels, const Grid& grid) const;
  [[nodiscard]] bool is_whole_square(std::size_t column, std::size_t row, const package::SurfacePixels& pixels) const;

  std::string name_;
  MappedFile file_;
  std::span<const float> height_m_;
  std::span<const std::uint8_t> joined_;
  std::optional<PixelsInGrid> in_grid_;
};

/// A surface that is written, whose heights are asked for row by row from the south: a large raster is not held a second time.
struct PixelHeightRows {
  std::function<void(std::size_t row, std::span<float> height_m)> heights_of;  ///< of a row, as PixelHeights has them
  std::span<const std::uint8_t> joined;                                        ///< as PixelHeights has them, of all pixels
  std::optional<PixelsInGrid> in_grid = {};                                    ///< where squares are left out
};

/// Writes `heights.bin` into the folder of a package, which is made where there is none, and returns its stamp. Throws
/// OutputError.
[[nodiscard]] package::FileStamp write_pixel_heights(const std::filesystem::path& folder, const package::SurfacePixels& pixels,
                                                     const PixelHeightRows& heights);
[[nodiscard]] package::FileStamp write_pixel_heights(const std::filesystem::path& folder, const package::SurfacePixels& pixels,
                                                     const PixelHeights& heights);

}  // namespace farlod
