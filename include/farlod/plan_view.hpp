// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "farlod/box.hpp"
#include "farlod/export.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/raster.hpp"
#include "farlod/run.hpp"

namespace farlod {

/// A piece of a line on a map, in the package's CRS.
struct PlanSegment {
  Point2d a, b;
  bool operator==(const PlanSegment&) const = default;
};

/// The outlines of the roofs of all buildings that meet a part of the city. Where the grid cuts a building, there is no line.
struct BuildingOutlines {
  std::vector<PlanSegment> segments;
  /// Edge of a square with as much outline for its area as the buildings have: how large they are, more or less. 0 without any.
  double typical_edge_m = 0.0;
};

/// The outlines in a rectangle of the package's CRS; empty when there are more than `most_segments`. Outlines that reach beyond
/// the rectangle are not cut. Throws InvalidArgument, Cancelled, LimitReached, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT std::optional<BuildingOutlines> building_outlines(const Package& package, const Box2d& part,
                                                                              std::size_t most_segments,
                                                                              const RunSettings& run = {});

/// Heights of the ground above sea level at the pixel centres of a raster, row by row from the north; NaN where there is no
/// ground, and beyond the grid. Throws InvalidArgument, Cancelled, LimitReached, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT std::vector<float> ground_heights(const Package& package, const RasterPlan& plan,
                                                              const RunSettings& run = {});

/// Heights above sea level at the pixel centres of a raster, row by row from the north; NaN where there is nothing.
struct PlanHeights {
  std::vector<float> ground_m;
  std::vector<float> highest_m;  ///< of the highest surface: a roof, a bridge, or the ground
};

/// Looks both up at once. Throws what ground_heights throws.
[[nodiscard]] FARLOD_EXPORT PlanHeights plan_heights(const Package& package, const RasterPlan& plan, const RunSettings& run = {});

/// Crowns above or below the pixel centres of a raster, row by row from the north: heights above sea level, NaN where there is no
/// crown.
struct PlanCanopy {
  std::vector<float> bottom_m;  ///< of the lowest crown
  std::vector<float> top_m;     ///< of the highest
};

/// Throws what ground_heights throws.
[[nodiscard]] FARLOD_EXPORT PlanCanopy plan_canopy(const Package& package, const RasterPlan& plan, const RunSettings& run = {});

}  // namespace farlod
