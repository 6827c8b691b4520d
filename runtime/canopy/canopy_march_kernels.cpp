// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "canopy/canopy_march.hpp"
#include "canopy/crown_sections.hpp"
#include "canopy/crown_union.hpp"
#include "horizon/lanes.hpp"
#include "horizon/sky_lanes.hpp"

// Compiled once for each target, which CMakeLists.txt names as FARLOD_TARGET. Everything here has internal linkage or is inlined
// always, but for the table at the end.

namespace farlod {
namespace {

constexpr std::int32_t row_end = static_cast<std::int32_t>(lane_count);

/// The highest top that sixteen receivers in a row can meet in a segment.
FARLOD_LANES float highest_top(const HighestAround& squares, std::int32_t x, std::int32_t y) {
  std::int32_t column = x >> squares.shift, row = y >> squares.shift;
  column = column < squares.first ? squares.first : (column > squares.last_column ? squares.last_column : column);
  row = row < squares.first ? squares.first : (row > squares.last_row ? squares.last_row : row);
  return squares.height_m[row * squares.stride + column];
}

constexpr std::size_t in_long = long_step / far_step;

/// What is behind crowns at an azimuth, as far as a ray has come: of the sky above the horizon; or of what is solid, below it.
/// There, solid things on the way hide slopes up to `solid`, and what of a crown is lower is behind them.
template <bool is_below>
struct CanopyRay {
  const CanopyFieldView& field;
  std::int32_t column, row;
  const float *top_m, *bottom_m, *solid_m;  ///< from the receivers' own pixels
  Floats z_m, horizon, solid, solid_before_m;
  Floats rest;  ///< sin² of the slopes at which nobody looked for crowns
  CrownUnion covered;

  FARLOD_LANES const Floats& hidden_below() const {
    if constexpr (is_below)
      return solid;
    else
      return covered.ground;
  }
  FARLOD_LANES Floats slope_to(float top_m_of_all, float per_distance) const {
    return (broadcast(top_m_of_all) - z_m) * broadcast(per_distance);
  }
  FARLOD_LANES bool are_hidden(const HighestAround& highest, const CanopySegment& s) const {
    const float top_m_of_all = highest_top(highest, column + s.x_low, row + s.y_low);
    return bits_of(slope_to(top_m_of_all, s.per_distance) > hidden_below()) == 0;
  }

  /// Takes receivers out to whose sky the rest of the way adds too little to count: slopes up to the highest crown there may be,
  /// and not those of the core. What they have depends on themselves alone, whoever else goes on. Returns whether anybody does.
  FARLOD_LANES bool go_on(float per_distance) {
    const Floats from = hidden_below();
    Floats highest = slope_to(field.highest_m, per_distance);
    if constexpr (is_below) highest = min(highest, horizon);
    const Floats to = max(choose(covered.core_high >= highest, min(covered.core_low, highest), highest), from);
    const Floats sky = to * to - from * from;
    const Mask goes_on = sky > broadcast(least_sky_behind);
    // Who was taken out before sees nothing on the way
    rest = max(rest, choose(goes_on, broadcast(0.0F), sky));
    z_m = choose(goes_on, z_m, broadcast(CanopyRow::no_receiver_m));
    return bits_of(goes_on) != 0;
  }

  FARLOD_LANES void pass(const CanopyCrossing& c) {
    const Floats high = (load(top_m + c.pixel) - z_m) * broadcast(c.per_entered);
    if (bits_of(high > hidden_below()) == 0) return;
    const Floats low = (load(bottom_m + c.pixel) - z_m) * broadcast(c.per_left);
    if constexpr (is_below)
      covered.join({max(low, solid), min(high, horizon), {}, {}});
    else
      covered.join({low, high, {}, {}});
  }
  /// To what is solid at the side where a pixel is entered: half-way between two that are joined, and otherwise the higher one.
  FARLOD_LANES void raise_solid(const CanopyCrossing& c) {
    const Floats next_m = load(solid_m + c.pixel);
    const Ints joined = (to_bits(solid_before_m) & c.joined_before) + (to_bits(next_m) & c.joined_here);
    const Floats side_m = choose(joined > broadcast(0), 0.5F * (next_m + solid_before_m), max(next_m, solid_before_m));
    solid = min(max(solid, (side_m - z_m) * broadcast(c.per_entered)), horizon);
    solid_before_m = next_m;
  }

  /// The number of long segments that begin above pixels.
  FARLOD_LANES std::size_t long_segments(const CanopyPath& path) const {
    const double in_x = (path.cosine > 0.0 ? field.columns - column : column + row_end) * path.per_cosine,
                 in_y = (path.sine > 0.0 ? field.rows - row : row + 1) * path.per_sine;
    const double steps = (in_x < in_y ? in_x : in_y) * (1.0 / long_step);
    const std::size_t count = steps > 0.0 ? static_cast<std::size_t>(steps) + 1 : 0;
    return count < path.long_segments.size() ? count : path.long_segments.size();
  }
  /// Segments are left out whose crowns are all hidden: first long ones, then short ones. What is solid counts everywhere.
  FARLOD_LANES void march(const CanopyPath& path) {
    const std::size_t count = in_long * long_segments(path);
    bool is_left_out = false;
    for (std::size_t n = 0; n < count; ++n) {
      const CanopySegment& s = path.segments[n];
      // Receivers are asked at each segment, also where nobody marches: who is left must not depend on others
      if (!go_on(s.per_distance)) return;
      if (!is_below && n % in_long == 0) is_left_out = are_hidden(field.long_highest, path.long_segments[n / in_long]);
      if (is_left_out) continue;
      const bool has_crowns = !are_hidden(field.highest, s);
      if (!is_below && !has_crowns) continue;
      for (std::uint32_t c = n == 0 ? 0 : path.segments[n - 1].end; c < s.end; ++c) {
        if constexpr (is_below) raise_solid(path.crossings[c]);
        if (has_crowns) pass(path.crossings[c]);
      }
    }
  }
};

/// What is behind crowns at one azimuth. The room is written to, through the union.
// NOLINTBEGIN(readability-non-const-parameter)
template <bool is_below>
FARLOD_LANES Floats march_one(const CanopyFieldView& field, const CanopyPath& path, const SkyWindow& above, const CanopyRow& row,
                              std::uint32_t azimuth, float* room) {
  const SkyStraightUp sky;
  const SkyWindow window = is_below ? SkyWindow{broadcast(0.0F), above.from, broadcast(1.0F)} : above;
  const std::ptrdiff_t own_pixel = row.row * field.stride + row.column;
  CanopyRay<is_below> ray{.field = field,
                          .column = row.column,
                          .row = row.row,
                          .top_m = field.top_m + own_pixel,
                          .bottom_m = field.bottom_m + own_pixel,
                          .solid_m = is_below ? field.solid_m + own_pixel : nullptr,
                          .z_m = load(row.z_m),
                          .horizon = above.from,
                          .solid = broadcast(0.0F),
                          .solid_before_m = broadcast(no_height_m),
                          .rest = broadcast(0.0F),
                          .covered = {.ground = is_below ? broadcast(none_high) : above.from,
                                      .low = room,
                                      .high = room + (path.crossings.size() + 2) * lane_count}};
  ray.march(path);
  // Half of what nobody looked at
  Floats behind = 0.5F * window.weight * ray.rest;
  for_each_run(ray.covered, [&](const Floats& from, const Floats& to, const Mask& ends) {
    const Floats seen = choose(ends, sky_within(window, sky, from, to), broadcast(0.0F));
    behind += seen;
    if constexpr (!is_below) tell_dimmed(row.dimmed, azimuth, seen, from, to, nullptr);
  });
  return behind;
}
// NOLINTEND(readability-non-const-parameter)

/// What all azimuths give, for the receivers of a row.
struct CanopySums {
  Sum behind{nullptr}, hidden{nullptr};
};

void march(const CanopyFieldView& field, std::span<const CanopyPath> paths, std::span<const CanopyRow> rows, float* room) {
  CanopySums sums[most_canopy_rows];
  for (std::size_t n = 0; n < rows.size(); ++n) {
    sums[n].behind.next_row = rows[n].behind;
    sums[n].hidden.next_row = rows[n].hidden;
  }
  // Azimuth by azimuth, so that a path is in the processor's cache for all rows
  for (std::size_t k = 0; k < paths.size(); ++k)
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const SkyWindow above = window_above({rows[n].sky_from, nullptr, nullptr, nullptr, rows[n].sky}, k, SkyStraightUp());
      const auto azimuth = static_cast<std::uint32_t>(k);
      sums[n].behind.add(march_one<false>(field, paths[k], above, rows[n], azimuth, room));
      if (field.solid_m != nullptr) sums[n].hidden.add(march_one<true>(field, paths[k], above, rows[n], azimuth, room));
    }
  const auto count = static_cast<float>(paths.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    store(sums[n].behind.total() / count, rows[n].sum_behind);
    if (field.solid_m != nullptr) store(sums[n].hidden.total() / count, rows[n].sum_hidden);
  }
}

}  // namespace

namespace FARLOD_TARGET {
extern const CanopyMarchKernels canopy_march_kernels;
constexpr CanopyMarchKernels canopy_march_kernels{.march = march};
}  // namespace FARLOD_TARGET

}  // namespace farlod
