// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "farlod/package.hpp"
#include "farlod/plan_view.hpp"
#include "farlod/raster.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/preview_raster.hpp"

namespace farlod {

/// What a map shows besides its values, so that a reader finds his way.
struct PlanBackground {
  /// Outlines of roofs, in pixels from the upper left corner of the map. None where there would be more than most_outlines, or
  /// where a building would be smaller than smallest_building pixels: they would hide the map.
  std::vector<Segment> outlines;
  /// Factors of the lightness of the map's pixels, row by row; empty where no ground rises visibly.
  std::vector<float> shading;
};

inline constexpr std::size_t most_outlines = 100'000;
inline constexpr double smallest_building = 2.0;

/// Looks the background of a map up, whose pixels are those of the plan.
[[nodiscard]] PlanBackground plan_background(const Package& package, const RasterPlan& plan, std::size_t threads);

/// How a ground is lit from the north-west, at 45° above the horizon, by its heights: 1 where it is level or unknown, more where
/// it looks to the light. Empty when it is level everywhere, to the eye.
[[nodiscard]] std::vector<float> shading_of(const std::vector<float>& heights_m, const RasterPlan& plan);

/// What the background of the largest preview holds: heights and shading of each pixel, outlines on the ground and on the page.
inline constexpr std::size_t bytes_of_largest_background =
    longest_preview_edge * longest_preview_edge * 2 * sizeof(float) + most_outlines * 3 * (sizeof(PlanSegment) + sizeof(Segment));

}  // namespace farlod
