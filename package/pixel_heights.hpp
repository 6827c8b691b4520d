// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"

namespace farlod {

/// The surface of a raster that a city is, pixel by pixel: row by row from the south, each row from the west.
struct PixelHeights {
  std::vector<float> height_m;       ///< at the centres of the pixels, as in tiles; NaN where there is none
  std::vector<std::uint8_t> joined;  ///< JoinedPixels of each; a wall stands on its other sides
};

/// Which pixels beside one the surface goes on to without a step. Both have a height.
struct JoinedPixels {
  static constexpr std::uint8_t east = 1, north = 2;
};

namespace package {

/// Whether a package is of a surface without walls, pixel for pixel, and of nothing else: rays march over its pixels sooner than
/// edges are drawn (docs/decisions/0032-a-march-over-pixels.md), and its cells need no far maps.
[[nodiscard]] bool is_natural_relief(const Manifest& manifest);

/// The bytes of `heights.bin`, which packages have whose manifest names it, and no others: a header, a float for each pixel and a
/// byte for each pixel. docs/package_format.md tells the same in words; where they differ, this file wins.
inline constexpr std::uint32_t heights_version = 1;
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

/// The `heights.bin` of a package, mapped. All is checked once: heights lie on Earth, and pixels are joined with such that have a
/// height.
class PixelHeightsFile {
 public:
  /// Opens that of a package whose manifest names it. Throws PackageDamaged or PackageUnusable.
  PixelHeightsFile(const PackageFolder& folder, const package::Manifest& manifest);

  [[nodiscard]] std::span<const float> height_m() const { return height_m_; }
  [[nodiscard]] std::span<const std::uint8_t> joined() const { return joined_; }
  /// Gives the memory back. It stays readable, and comes back from the file when somebody reads it.
  void let_go() const { file_.let_go(); }

 private:
  void require(bool rule, const char* what) const { require_whole(rule, name_, what); }
  void check_pixels(const package::SurfacePixels& pixels) const;

  std::string name_;
  MappedFile file_;
  std::span<const float> height_m_;
  std::span<const std::uint8_t> joined_;
};

/// Writes `heights.bin` into the folder of a package, which is made where there is none, and returns its stamp. Throws
/// OutputError.
[[nodiscard]] package::FileStamp write_pixel_heights(const std::filesystem::path& folder, const package::SurfacePixels& pixels,
                                                     const PixelHeights& heights);

}  // namespace farlod
