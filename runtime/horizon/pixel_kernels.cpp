// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "horizon/lanes.hpp"
#include "horizon/pixel_march.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

constexpr std::int32_t east = 1, north = 2;  // JoinedPixels
constexpr std::int32_t last_lane = static_cast<std::int32_t>(lane_count) - 1,
                       last_row = static_cast<std::int32_t>(PixelBlock::rows) - 1;

/// A number of pixels in 2^-32 of one: the whole ones below it, and the rest.
struct FixedPoint {
  FARLOD_LANES explicit FixedPoint(std::int64_t n)
      : whole(static_cast<std::int32_t>(n >> 32)), part(static_cast<float>(n & 0xFFFFFFFF) * 0x1p-32F) {}
  std::int32_t whole;
  float part;
};
/// Half a pixel more than where a ray is aside half a line before the n-th.
FARLOD_LANES std::int64_t half_before(std::int32_t n, std::int64_t per_line, std::int64_t first) {
  return n * per_line - per_line / 2 + first + (std::int64_t{1} << 31);
}
template <class Number>
FARLOD_LANES Number lowest_of(Number a, Number b) {
  return b < a ? b : a;
}
template <class Number>
FARLOD_LANES Number highest_of(Number a, Number b) {
  return a < b ? b : a;
}

FARLOD_LANES float highest_from(const HighestAround& squares, std::int32_t x, std::int32_t y) {
  const std::int32_t column = lowest_of(highest_of(x >> squares.shift, squares.first), squares.last_column),
                     row = lowest_of(highest_of(y >> squares.shift, squares.first), squares.last_row);
  return squares.height_m[row * squares.stride + column];
}

/// The horizons of a block at one azimuth, as far as they are drawn.
struct Horizon {
  Floats z_m[PixelBlock::rows], slope[PixelBlock::rows];
  float lowest_z_m, lowest_slope = 0.0F;

  FARLOD_LANES explicit Horizon(const PixelBlock& block) {
    Floats lowest = broadcast(PixelBlock::no_receiver_m);
    for (std::size_t r = 0; r < PixelBlock::rows; ++r) {
      z_m[r] = load(block.z_m[r]);
      // What has no receiver is not the lowest horizon, however high others are
      slope[r] = choose(z_m[r] < broadcast(PixelBlock::no_receiver_m), broadcast(0.0F), broadcast(PixelBlock::no_receiver_m));
      lowest = min(lowest, z_m[r]);
    }
    lowest_z_m = min_lane(lowest);
  }
  FARLOD_LANES bool may_be_raised_to(float height_m, float per_distance) const {
    return (height_m - lowest_z_m) * per_distance > lowest_slope && is_raised_to(height_m, per_distance);
  }
  /// Who stands low has a high horizon: asks each receiver by itself.
  FARLOD_LANES bool is_raised_to(float height_m, float per_distance) const {
    std::uint32_t raised = 0;
    for (std::size_t r = 0; r < PixelBlock::rows; ++r)
      raised |= bits_of((broadcast(height_m) - z_m[r]) * broadcast(per_distance) > slope[r]);
    return raised != 0;
  }
  FARLOD_LANES void note_lowest() {
    Floats lowest = slope[0];
    for (std::size_t r = 1; r < PixelBlock::rows; ++r) lowest = min(lowest, slope[r]);
    lowest_slope = min_lane(lowest);
  }
};

/// The receivers of a row of a block, and their horizons: few enough numbers for registers, so that a segment is passed row by
/// row.
struct HorizonOfRow {
  Floats z_m, slope;

  FARLOD_LANES HorizonOfRow(const Horizon& horizon, std::size_t row) : z_m(horizon.z_m[row]), slope(horizon.slope[row]) {}
  FARLOD_LANES void raise_to(const Floats& height_m, float per_distance) {
    slope = max(slope, (height_m - z_m) * broadcast(per_distance));
  }
};

FARLOD_LANES Floats height_at(const float* pixel, const PixelCrossing& c) {
  return load(pixel + c.pixel) + c.share * load(pixel + c.slope);
}

FARLOD_LANES void pass_lines(const float* pixel, std::span<const PixelCrossing> lines, HorizonOfRow& row) {
  for (const PixelCrossing& line : lines) row.raise_to(height_at(pixel, line), line.per_distance);
}
FARLOD_LANES void pass_sides(const float* pixel, std::span<const SideCrossing> sides, HorizonOfRow& row) {
  for (const SideCrossing& side : sides)
    row.raise_to(max(height_at(pixel, side.first), height_at(pixel, side.second)) + load(pixel + side.torn),
                 side.first.per_distance);
}

/// Passes all that a segment crosses.
FARLOD_LANES void pass_near(std::span<const PixelCrossing> lines, std::span<const SideCrossing> sides, const float* pixel,
                            std::ptrdiff_t stride, Horizon& horizon) {
  for (std::size_t r = 0; r < PixelBlock::rows; ++r, pixel += stride) {
    HorizonOfRow row(horizon, r);
    pass_lines(pixel, lines, row);
    pass_sides(pixel, sides, row);
    horizon.slope[r] = row.slope;
  }
  horizon.note_lowest();
}

FARLOD_LANES void march_near(const PixelWindowView& window, const PixelPath& path, const PixelBlock& block, Horizon& horizon) {
  const float* const pixel = window.height_m + block.window_y * window.stride + block.window_x;
  std::uint32_t crossing = 0, side = 0;
  for (const NearSegment& segment : path.near) {
    const float highest_m = highest_from(window.highest, block.window_x + segment.x_low, block.window_y + segment.y_low);
    if (horizon.may_be_raised_to(highest_m, segment.per_distance))
      pass_near(path.crossings.subspan(crossing, segment.crossings_end - crossing),
                path.sides.subspan(side, window.is_torn ? segment.sides_end - side : 0), pixel, window.stride, horizon);
    crossing = segment.crossings_end;
    side = segment.sides_end;
  }
}

/// A line beyond the window: between the centres of two pixels, or the side between them.
struct FarLine {
  const float *from, *to;  ///< that the ray of the first receiver passes
  const float* nearer;     ///< one of them
  float share, per_line;   ///< of the way between them; 1 / how many lines away
};
/// Those of one kind in a segment.
struct FarLines {
  static constexpr std::size_t most = far_step + 2;
  FarLine lines[most];
  std::size_t count = 0;

  FARLOD_LANES void add(const FarLine& line) { lines[count++] = line; }
};

/// What a ray from a block meets beyond the window.
template <bool is_torn>
struct FarRay {
  const PixelFieldView& field;
  const PixelPath& path;
  const PixelBlock& block;
  Horizon& horizon;

  FARLOD_LANES const float* pixel_at(std::int32_t x, std::int32_t y) const {
    return field.height_m + (block.row + y) * field.stride + block.column + x;
  }
  FARLOD_LANES static Mask is_joined(const Floats& flagged, std::int32_t flag) {
    return (to_bits(flagged) & flag) == broadcast(flag);
  }
  /// The height at the share of the way: on the surface that joins both pixels, or on the nearer one. All of a row of a block lie
  /// so far behind those of the line.
  FARLOD_LANES static Floats height_at(const FarLine& line, std::ptrdiff_t behind, std::int32_t flag) {
    const Floats from = load(line.from + behind), sloped = from + line.share * (load(line.to + behind) - from);
    if constexpr (is_torn)
      return choose(is_joined(from, flag), sloped, load(line.nearer + behind));
    else
      return sloped;
  }
  /// Raises horizons to what rises from line to line.
  FARLOD_LANES static void pass_lines(const FarLines& all, std::ptrdiff_t behind, std::int32_t flag, float lines_per_metre,
                                      HorizonOfRow& row) {
    Floats rise = broadcast(0.0F);
    for (std::size_t n = 0; n < all.count; ++n)
      rise = max(rise, (height_at(all.lines[n], behind, flag) - row.z_m) * broadcast(all.lines[n].per_line));
    row.slope = max(row.slope, rise * broadcast(lines_per_metre));
  }
  /// Over the sides of two pixels, where the surface is torn.
  FARLOD_LANES static void pass_sides(const FarLines& all, std::ptrdiff_t behind, std::int32_t flag, HorizonOfRow& row) {
    for (std::size_t n = 0; n < all.count; ++n) {
      const Floats a = load(all.lines[n].from + behind);
      row.raise_to(choose(is_joined(a, flag), broadcast(no_height_m), max(a, load(all.lines[n].to + behind))),
                   all.lines[n].per_line);
    }
  }

  /// The lines between the ends of two segments.
  FARLOD_LANES void march(const FarSegment& before, const FarSegment& segment) {
    const FarLines columns = columns_between(before.columns_end, segment.columns_end),
                   rows = rows_between(before.rows_end, segment.rows_end);
    const FarLines east_sides = is_torn ? east_sides_between(before.east_sides_end, segment.east_sides_end) : FarLines(),
                   north_sides = is_torn ? north_sides_between(before.north_sides_end, segment.north_sides_end) : FarLines();
    for (std::size_t r = 0; r < PixelBlock::rows; ++r) {
      HorizonOfRow row(horizon, r);
      const std::ptrdiff_t behind = static_cast<std::ptrdiff_t>(r) * field.stride;
      pass_lines(columns, behind, north, path.columns_per_metre, row);
      pass_lines(rows, behind, east, path.rows_per_metre, row);
      pass_sides(east_sides, behind, east, row);
      pass_sides(north_sides, behind, north, row);
      horizon.slope[r] = row.slope;
    }
  }
  FARLOD_LANES std::int32_t x_sign() const { return path.cosine < 0.0 ? -1 : 1; }
  FARLOD_LANES std::int32_t y_sign() const { return path.sine < 0.0 ? -1 : 1; }
  FARLOD_LANES FarLines columns_between(std::int32_t first, std::int32_t end) const {
    FarLines lines;
    for (std::int32_t n = first; n < end; ++n) {
      const FixedPoint y(n * path.north_per_column + path.north_first);
      const float* const from = pixel_at(x_sign() * n, y.whole);
      lines.add({from, from + field.stride, y.part < 0.5F ? from : from + field.stride, y.part,
                 1.0F / (static_cast<float>(n) - path.column_lead)});
    }
    return lines;
  }
  FARLOD_LANES FarLines rows_between(std::int32_t first, std::int32_t end) const {
    FarLines lines;
    for (std::int32_t n = first; n < end; ++n) {
      const FixedPoint x(n * path.east_per_row + path.east_first);
      const float* const from = pixel_at(x.whole, y_sign() * n);
      lines.add({from, from + 1, x.part < 0.5F ? from : from + 1, x.part, 1.0F / (static_cast<float>(n) - path.row_lead)});
    }
    return lines;
  }
  FARLOD_LANES static float per_side(std::int32_t n, float lead) { return 1.0F / (static_cast<float>(n) - 0.5F - lead); }
  FARLOD_LANES FarLines east_sides_between(std::int32_t first, std::int32_t end) const {
    FarLines sides;
    for (std::int32_t n = first; n < end; ++n) {
      const FixedPoint y(half_before(n, path.north_per_column, path.north_first));
      const float* const from = pixel_at(x_sign() < 0 ? -n : n - 1, y.whole);
      sides.add({from, from + 1, from, 0.0F, path.columns_per_metre * per_side(n, path.column_lead)});
    }
    return sides;
  }
  FARLOD_LANES FarLines north_sides_between(std::int32_t first, std::int32_t end) const {
    FarLines sides;
    for (std::int32_t n = first; n < end; ++n) {
      const FixedPoint x(half_before(n, path.east_per_row, path.east_first));
      const float* const from = pixel_at(x.whole, y_sign() < 0 ? -n : n - 1);
      sides.add({from, from + field.stride, from, 0.0F, path.rows_per_metre * per_side(n, path.row_lead)});
    }
    return sides;
  }

  FARLOD_LANES bool may_be_raised(const HighestAround& highest, const FarSegment& segment) const {
    return horizon.may_be_raised_to(highest_from(highest, block.column + segment.x_low, block.row + segment.y_low),
                                    segment.per_distance);
  }
  /// The number of long segments that begin above pixels, for some receiver.
  FARLOD_LANES std::size_t long_segments() const {
    const double in_x = (path.cosine > 0.0 ? field.columns - block.column : block.column + last_lane + 1) * path.per_cosine,
                 in_y = (path.sine > 0.0 ? field.rows - block.row : block.row + last_row + 1) * path.per_sine;
    const double steps = (lowest_of(in_x, in_y) - pixel_reach) * (1.0 / long_step);
    return steps > 0.0 ? static_cast<std::size_t>(steps) + 1 : 0;
  }
  /// Segments are left out that are too low: first long ones, then short ones.
  FARLOD_LANES void march() {
    constexpr std::size_t in_long = long_step / far_step;
    const std::size_t count = long_segments();
    for (std::size_t l = 0; l < count; ++l) {
      const FarSegment& all = path.long_far[l + 1];
      if (!horizon.may_be_raised_to(field.highest_m, all.per_distance)) return;
      if (!may_be_raised(field.long_highest, all)) continue;
      for (std::size_t n = l * in_long; n < (l + 1) * in_long; ++n) {
        const FarSegment& segment = path.far[n + 1];
        if (!may_be_raised(field.highest, segment)) continue;
        march(path.far[n], segment);
        horizon.note_lowest();
      }
    }
  }
};

/// The horizons of blocks at the azimuths of some paths.
template <bool is_torn>
struct HorizonsOfBlocks {
  const PixelWindowView& window;
  const PixelFieldView& field;
  std::span<const PixelPath> paths;

  FARLOD_LANES Horizon march_at(std::size_t k, const PixelBlock& block) const {
    Horizon horizon(block);
    march_near(window, paths[k], block, horizon);
    FarRay<is_torn>{field, paths[k], block, horizon}.march();
    return horizon;
  }
  FARLOD_LANES void draw_at(std::size_t k, const PixelBlock& block) const {
    const Horizon horizon = march_at(k, block);
    for (std::size_t r = 0; r < PixelBlock::rows; ++r)
      if (block.slopes[r] != nullptr) store(horizon.slope[r], at(block, r, k));
  }
  /// In the middle between two azimuths: of each receiver by itself, so that its horizon does not depend on others.
  FARLOD_LANES void draw_between(std::size_t before, std::size_t after, std::size_t k, const PixelBlock& block) const {
    Floats mean[PixelBlock::rows]{};
    Mask is_steep[PixelBlock::rows]{};
    std::uint32_t steep = 0;
    for (std::size_t r = 0; r < PixelBlock::rows; ++r) {
      if (block.slopes[r] == nullptr) continue;
      const Floats a = load(at(block, r, before)), b = load(at(block, r, after));
      mean[r] = broadcast(0.5F) * (a + b);
      // Where there is no receiver, both are the same
      is_steep[r] = max(a - b, b - a) > broadcast(level_slope);
      steep |= bits_of(is_steep[r]);
    }
    const Horizon horizon = steep != 0 ? march_at(k, block) : Horizon(block);
    for (std::size_t r = 0; r < PixelBlock::rows; ++r)
      if (block.slopes[r] != nullptr) store(choose(is_steep[r], horizon.slope[r], mean[r]), at(block, r, k));
  }
  FARLOD_LANES static float* at(const PixelBlock& block, std::size_t row, std::size_t k) {
    return block.slopes[row] + k * lane_count;
  }
};

template <bool is_torn>
FARLOD_LANES void march_all(const HorizonsOfBlocks<is_torn>& horizons, std::span<const PixelBlock> blocks, std::size_t step) {
  const std::size_t azimuths = horizons.paths.size();
  // Azimuth by azimuth, so that a path is in the processor's cache for all blocks
  for (std::size_t k = 0; k < azimuths; k += step)
    for (const PixelBlock& block : blocks) horizons.draw_at(k, block);
  for (std::size_t half = step / 2; half > 0; half /= 2)
    for (std::size_t k = half; k < azimuths; k += 2 * half) {
      const std::size_t after = k + half < azimuths ? k + half : 0;
      for (const PixelBlock& block : blocks) horizons.draw_between(k - half, after, k, block);
    }
}

void march(const PixelWindowView& window, const PixelFieldView& field, std::span<const PixelPath> paths,
           std::span<const PixelBlock> blocks, std::size_t step) {
  if (field.is_torn)
    march_all<true>({window, field, paths}, blocks, step);
  else
    march_all<false>({window, field, paths}, blocks, step);
}

}  // namespace

namespace FARLOD_TARGET {
extern const PixelKernels pixel_kernels;
constexpr PixelKernels pixel_kernels{.march = march};
}  // namespace FARLOD_TARGET

}  // namespace farlod
