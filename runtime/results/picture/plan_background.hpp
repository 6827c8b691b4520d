// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "farlod/package.hpp"
#include "farlod/raster.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/picture.hpp"

namespace farlod {

/// What a map shows besides its values, so that a reader finds his way.
struct PlanBackground {
  /// Outlines of roofs, in pixels from the upper left corner of the map. None where there would be more than most_outlines, or
  /// where a building would be smaller than smallest_building pixels: they would hide the map.
  std::vector<Segment> outlines;
  /// Factors of the lightness of pixels without a value, row by row; empty where no ground rises visibly.
  std::vector<float> shading;
  /// Whether a building covers the pixel, row by row; empty where no pixel asks.
  std::vector<bool> is_covered = {};
  /// Whether the pixel is of the building that receivers look for, row by row; empty where there is none.
  std::vector<bool> is_landmark = {};
};

/// The colours of the building that receivers look for, and of places that see nothing of it: those of no value, nor of a line.
inline constexpr Colour landmark_colour{213, 94, 0}, unseen_colour{206, 222, 240};

/// With all pixels that lie so many columns or rows beside one that is covered, row by row: what has no value has its middle
/// covered, or most of it, and perhaps not the pixels at its edge.
[[nodiscard]] std::vector<bool> widened(const std::vector<bool>& is_covered, std::size_t columns, std::size_t by);

/// The greys of pixels without a value: of buildings, which have a roof there, and of all else.
inline constexpr Colour covered_grey = nodata_colour, no_value_grey{236, 236, 234};

inline constexpr std::size_t most_outlines = 100'000;
inline constexpr double smallest_building = 2.0;

/// Looks the background of a map up, whose pixels are those of the plan. Without pixels that have no value, it is outlines alone.
[[nodiscard]] PlanBackground plan_background(const Package& package, const RasterPlan& plan, std::size_t threads,
                                             bool has_pixels_without_value = true);

/// Changes of lightness below this are not seen.
inline constexpr float visible_light = 0.03F;

/// How a ground is lit from the north-west, at 45° above the horizon, by its heights: 1 where it is level or unknown, more where
/// it looks to the light. Empty when it is level everywhere, to the eye.
[[nodiscard]] std::vector<float> shading_of(const std::vector<float>& heights_m, const RasterPlan& plan);

}  // namespace farlod
