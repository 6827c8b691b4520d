// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/frame.hpp"
#include "base/paging/paged_array.hpp"
#include "city/city_model.hpp"
#include "farlod/point.hpp"
#include "tiles/horizon_edges.hpp"
#include "tiles/pixel_steps.hpp"

namespace farlod::tiles {

/// A surface model as what stands: a surface through the centres of its pixels, torn along the sides of pixels that are a step
/// apart, where upright walls stand.
///   (1) it covers the whole pixels that have a height, and passes through the height of each at its centre
///   (2) seen from above, its triangles that are not upright partition these pixels; walls stand on sides of pixels only
///   (3) what is level within a pixel's quarter, and beside it, is joined to rectangles
///   (4) its edges are all that can be a horizon
struct SteppedSurface {
  PagedArray<std::array<Point3d, 3>> triangles;  ///< grid frame; counter-clockwise seen from above, but for walls
  PagedArray<HorizonSegment> edges;
  /// How many of them, the first ones, are not left to readers.
  std::size_t stored_triangles = 0, stored_edges = 0;
};

/// What becomes of the squares that are left to readers (PixelSteps::leave_out_squares): of their triangles, of their folds, and
/// of the sides between two of them.
enum class SquaresOfReaders : std::uint8_t {
  behind,  ///< they come behind the rest
  absent   ///< they are missing
};

[[nodiscard]] SteppedSurface stepped_surface(const TerrainRaster& raster, const PixelSteps& steps, const GridRotation& rotation,
                                             SquaresOfReaders squares = SquaresOfReaders::behind);

}  // namespace farlod::tiles
