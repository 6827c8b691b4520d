// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "horizon/receiver_packet.hpp"

/// What the march over pixels reads (PixelHorizon): receivers that stand alike in their pixels, such as at the centres, see the
/// same crossings, each from its own pixel. Lengths are in pixels but for heights; planes are arrays of floats, rows from the
/// south, of one stride. A pixel without a height lies at `no_height_m`. docs/concepts.md, "A march over pixels".
namespace farlod {

inline constexpr float no_height_m = -1e30F;

/// A line of the surface that a ray passes over: `height[pixel] + share · plane[slope]`, both counted from the receiver's pixel
/// in the window's planes.
struct PixelCrossing {
  std::int32_t pixel, slope;
  float share, per_distance;  ///< 1 / distance
};
/// The side of a pixel that a ray passes over, where the surface may be torn: the higher of both.
struct SideCrossing {
  PixelCrossing first, second;
  std::int32_t torn;  ///< in a plane that is 0 where the side is torn, and `no_height_m` elsewhere
};
/// What a path crosses between two distances: up to these ends, from those of the segment before. Pixels are read from (x_low,
/// y_low) on, no more than HighestAround looks at.
struct NearSegment {
  std::uint32_t crossings_end, sides_end;
  std::int32_t x_low, y_low;
  float per_distance;  ///< of the nearest
};
/// The same beyond the window. Lines are counted from the receiver: those through the centres of columns and rows, and the sides
/// half a pixel before them.
struct FarSegment {
  std::int32_t columns_end, rows_end, east_sides_end, north_sides_end;
  std::int32_t x_low, y_low;
  float per_distance;
};
/// The way at one azimuth, (cosine, sine) of which is counted from the east.
struct PixelPath {
  double cosine, sine;
  double per_cosine, per_sine;                  ///< |1 / cosine|, |1 / sine|
  std::int64_t north_per_column, east_per_row;  ///< how far it goes aside from one line to the next, in 2^-32
  std::int64_t north_first, east_first;         ///< where it would begin, by that, on the lines through the receiver's pixel
  float column_lead, row_lead;                  ///< by how much lines are nearer than from the centre of the pixel
  float columns_per_metre, rows_per_metre;      ///< how many lines it passes
  std::span<const NearSegment> near;
  std::span<const PixelCrossing> crossings;
  std::span<const SideCrossing> sides;
  std::span<const FarSegment> far, long_far;  ///< of `far_step` and of `long_step` pixels, from where `near` ends
};
inline constexpr std::int32_t pixel_reach = 32, far_step = 8, long_step = 64;

/// The highest of the pixels that the receivers of a block can see in a segment: of every square of 2^shift pixels along
/// its edge, and those after it, `across` in a row and `along` rows. There is room for all places that are asked for, once they
/// are moved to `first` and `last`.
struct HighestAround {
  const float* height_m;  ///< of the square of pixel (0, 0)
  std::ptrdiff_t stride;
  std::int32_t first, last_column, last_row;
  std::uint32_t shift;
};

/// The planes of a window of pixels around receivers, in which paths have room.
struct PixelWindowView {
  const float* height_m;  ///< the first of the planes
  std::ptrdiff_t stride;
  HighestAround highest;
  bool is_torn;  ///< somewhere
};
/// All pixels. The two lowest bits of a height are JoinedPixels. There is room for sixteen pixels, and more, around.
struct PixelFieldView {
  const float* height_m;  ///< of the first pixel
  std::ptrdiff_t stride;
  std::int32_t columns, rows;
  HighestAround highest, long_highest;
  float highest_m;
  bool is_torn;
};

/// From one azimuth to the next, a horizon without a jump differs by less: a jump of it that is missed moves the sky view factor
/// of 320 azimuths by .0001.
inline constexpr float level_slope = 0.1F;

/// Receivers above the pixels of a block: four rows of sixteen, from its south-western pixel.
struct PixelBlock {
  static constexpr std::size_t rows = 4;
  /// Where there is no receiver: nothing is seen from there.
  static constexpr float no_receiver_m = 1e30F;

  alignas(64) float z_m[rows][packet_lanes];  ///< of each
  float* slopes[rows];                        ///< [azimuth][pixel], to be drawn; null where a row has no receivers
  std::int32_t window_x, window_y, column, row;
};

struct PixelKernels {
  /// Draws horizons: the largest slope to anything on the way, at least 0, at each azimuth. Rays march at every `step`-th of
  /// them, a power of two that divides their number. In the middle between two, they march for blocks in which a receiver's
  /// slopes differ by more than `level_slope`; those of others are the mean of both. docs/concepts.md, "A march over pixels".
  void (*march)(const PixelWindowView& window, const PixelFieldView& field, std::span<const PixelPath> paths,
                std::span<const PixelBlock> blocks, std::size_t step);
};

}  // namespace farlod
