// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "canopy/dimmed_sky.hpp"
#include "horizon/pixel_march.hpp"
#include "horizon/receiver_packet.hpp"

/// What the march over the pixels of a canopy reads (CanopyMarch): receivers at the centres of its pixels pass the same pixels at
/// the same distances, each from its own. Lengths are in pixels but for heights; planes are arrays of floats, rows from the
/// south, of one stride. docs/concepts.md, "Canopies of rasters".
namespace farlod {

/// A pixel that a ray passes, counted from the receiver's, and 1 / distance of where it is entered and left, in 1/m. It is joined
/// with the pixel before if that one, or this one, has these JoinedPixels; through a corner it is not.
struct CanopyCrossing {
  std::int32_t pixel;
  float per_entered, per_left;
  std::int32_t joined_before, joined_here;
};
/// What is entered between two distances: up to this end, from that of the segment before. Its pixels are read from (x_low,
/// y_low) on, no more than HighestAround looks at.
struct CanopySegment {
  std::uint32_t end;
  std::int32_t x_low, y_low;
  float per_distance;  ///< of the nearest
};
/// The way at one azimuth, (cosine, sine) of which is counted from the east.
struct CanopyPath {
  double cosine, sine;
  double per_cosine, per_sine;  ///< |1 / cosine|, |1 / sine|
  std::span<const CanopyCrossing> crossings;
  std::span<const CanopySegment> segments, long_segments;  ///< of `far_step` and of `long_step` pixels, from the receiver on
};

/// All pixels of a canopy, and room around them.
struct CanopyFieldView {
  const float *top_m, *bottom_m;  ///< of the first pixel; the top is `no_height_m` where there is no crown
  /// What is no crown, where it is known, in the same places, as PixelFieldView has it. Or null
  const float* solid_m;
  std::ptrdiff_t stride;
  std::int32_t columns, rows;
  HighestAround highest, long_highest;  ///< tops
  float highest_m;
};

/// Sixteen pixels in a row, from this one on, with receivers that look straight up. Rows are arrays float[azimuth][pixel].
struct CanopyRow {
  /// Where there is no receiver: nothing is seen from there.
  static constexpr float no_receiver_m = 1e30F;

  alignas(64) float z_m[packet_lanes];
  const float *sky_from, *sky;  ///< rows, as those of SkyRows; `sky` may be null
  float *behind, *hidden;       ///< rows: take the sky behind crowns, and solid things behind crowns, F of each azimuth. Or null
  float *sum_behind, *sum_hidden;  ///< take the means over the azimuths, one number a pixel
  DimmedTaker dimmed;              ///< of the sky behind crowns; lanes are pixels
  std::int32_t column, row;
};

struct CanopyMarchKernels {
  /// Finds what is behind crowns. Solid things count if the field knows them. `room` has place for
  /// two rows for each crossing of the longest path, and for two crossings more.
  void (*march)(const CanopyFieldView& field, std::span<const CanopyPath> paths, std::span<const CanopyRow> rows, float* room);
};

/// Receivers in a square of so many pixels are marched together, row by row.
inline constexpr std::int32_t canopy_square = 16;
/// More rows are not marched at once.
inline constexpr std::size_t most_canopy_rows = 16;
/// Where the rest of the way may add less of the sky than that, at an azimuth, half of it counts.
inline constexpr float least_sky_behind = 1.6e-3F;

}  // namespace farlod
