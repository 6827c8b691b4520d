// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "horizon/pixel_march.hpp"
#include "package/manifest.hpp"
#include "package/pixel_middle.hpp"

namespace farlod {

/// HighestAround of a plane.
class HighestPixels {
 public:
  /// How many squares one looks at.
  struct Around {
    std::uint32_t shift;
    std::int32_t across, along;
  };
  /// Looks at columns × rows pixels, whose rows are `stride` apart.
  HighestPixels(const float* height_m, std::ptrdiff_t stride, std::int32_t columns, std::int32_t rows, const Around& around);
  [[nodiscard]] HighestAround view() const;

 private:
  Around around_;
  std::int32_t columns_, rows_;  ///< squares
  std::vector<float> height_m_;
};

/// A segment reaches over its length, a pixel at either end, and the receivers of a block; and begins anywhere in a square.
inline constexpr HighestPixels::Around around_far_step{1, 14, 8}, around_long_step{4, 7, 6};
constexpr bool reaches_over(const HighestPixels::Around& around, std::int32_t step) {
  const std::int32_t square = 1 << around.shift, aside = step + 3 + square - 1;
  return square * around.across >= aside + 15 && square * around.along >= aside + 3;
}
static_assert(reaches_over(around_far_step, far_step) && reaches_over(around_long_step, long_step));

/// A height with JoinedPixels, as PixelFieldView has it.
[[nodiscard]] float flagged_height(float height_m, std::uint32_t joined);

/// All pixels of a raster that is a city, and its heights, as marches read them: four bytes a pixel.
class PixelField {
 public:
  /// Heights and what is joined are those of PixelHeightsFile.
  PixelField(const package::SurfacePixels& pixels, std::span<const float> height_m, std::span<const std::uint8_t> joined);

  [[nodiscard]] PixelFieldView view() const;
  [[nodiscard]] double pixel_m() const { return pixel_m_; }
  /// From a corner to the opposite one.
  [[nodiscard]] double diagonal() const { return std::hypot(columns_, rows_); }
  [[nodiscard]] bool contains(std::int32_t column, std::int32_t row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  /// The four pixels of which this one is the south-west; those beyond the raster have no height.
  [[nodiscard]] FourPixels four_from(std::int32_t column, std::int32_t row) const;

 private:
  void fill(std::span<const float> height_m, std::span<const std::uint8_t> joined);
  /// Room around the pixels: for the receivers of a packet beyond either end of a row, and for a line beyond the last.
  static constexpr std::int32_t columns_aside = 80, rows_aside = 48;
  [[nodiscard]] const float* first() const { return height_m_.data() + rows_aside * stride_ + columns_aside; }

  double pixel_m_;
  std::int32_t columns_, rows_;
  std::ptrdiff_t stride_;
  std::vector<float> height_m_;  ///< flagged: PixelFieldView
  HighestPixels around_, long_around_;
  float highest_m_ = no_height_m;
  bool is_torn_ = false;
};

/// The planes of a window: its pixels' heights; by how much the surface rises to the next pixel to the east, or to the north,
/// where they are joined; from the centre of each of four pixels to the corner that they share, of which this one is the
/// south-west; and whether it is torn from the pixel to the east, or to the north.
enum class PixelPlane : std::uint8_t { height, east, north, to_middle, torn_east = to_middle + 4, torn_north };
inline constexpr std::int32_t pixel_planes = static_cast<std::int32_t>(PixelPlane::torn_north) + 1;

/// What the receivers of a square of `edge` pixels see nearby, exactly.
class PixelWindow {
 public:
  static constexpr std::int32_t edge = 64;
  static constexpr std::int32_t margin = pixel_reach + 2;
  static constexpr std::int32_t columns = edge + static_cast<std::int32_t>(packet_lanes) + 2 * margin, rows = edge + 2 * margin;
  /// From one plane to the next.
  static constexpr std::int32_t plane = columns * rows;

  explicit PixelWindow(const PixelField& field);
  /// Moves to the square with this south-western pixel.
  void look_at(std::int32_t column, std::int32_t row);
  [[nodiscard]] PixelWindowView view() const;
  /// The share of its pixels that are torn from a neighbor.
  [[nodiscard]] double torn_share() const { return static_cast<double>(torn_) / plane; }
  [[nodiscard]] std::int32_t x_of(std::int32_t column) const { return column - column_; }
  [[nodiscard]] std::int32_t y_of(std::int32_t row) const { return row - row_; }

 private:
  void fill(std::int32_t x, std::int32_t y);
  [[nodiscard]] float& at(PixelPlane which, std::size_t n, std::size_t pixel) {
    return planes_[(static_cast<std::size_t>(which) + n) * static_cast<std::size_t>(plane) + pixel];
  }

  const PixelField& field_;
  std::int32_t column_ = 0, row_ = 0;  ///< of the window's first pixel
  std::size_t torn_ = 0;               ///< pixels that are, from that to the east or to the north
  std::vector<float> planes_;
  std::optional<HighestPixels> highest_;  ///< once it looks at something
};

/// Where receivers stand in their pixel, from its centre to the east and to the north: in parts of a pixel, up to half of one.
struct PixelOffset {
  static constexpr double parts = 8192.0;
  std::int16_t east = 0, north = 0;
  [[nodiscard]] Point2d in_pixels() const { return {east / parts, north / parts}; }
  auto operator<=>(const PixelOffset&) const = default;
};

/// The paths at the azimuths of a sampling.
class PixelPaths {
 public:
  /// Directions from a place in a pixel, counted from the east, over a field.
  PixelPaths(std::span<const Point2d> directions, const PixelField& field, const PixelOffset& offset = {});
  [[nodiscard]] std::span<const PixelPath> paths() const { return paths_; }

 private:
  struct Counts {
    std::size_t near, crossings, sides, far, long_far;
  };
  [[nodiscard]] Counts counts() const;
  void add_near(Point2d direction, Point2d offset, double pixel_m);

  std::vector<PixelPath> paths_;
  std::vector<NearSegment> near_;
  std::vector<FarSegment> far_, long_far_;
  std::vector<PixelCrossing> crossings_;
  std::vector<SideCrossing> sides_;
};

}  // namespace farlod
