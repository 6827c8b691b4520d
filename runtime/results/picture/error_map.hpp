// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "farlod/evaluation.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/raster_preview.hpp"

namespace farlod {

/// What lies below the receivers of a map of errors: values, in grey, or NaN where there are none.
struct GreyMap {
  Point2d north_west_m;
  PreviewRaster raster;

  [[nodiscard]] RasterPlan plan() const { return {north_west_m, raster.metres_per_pixel, raster.columns, raster.rows}; }
};

/// A map without values around the receivers, or, if there are none, around `otherwise`.
[[nodiscard]] GreyMap map_around(std::span<const VerifiedReceiver> receivers, const Box2d& otherwise);

/// The error to which the colours reach: 1, 2 or 5 times a power of ten, not below the 99th percentile, nor below .0001.
[[nodiscard]] double error_of_full_colour(const ErrorSummary& errors);

struct ErrorMapCaption {
  std::string quantity;  ///< "svf" or "svf_solid"
  std::string crs;
};

/// The map in grey with a mark at each receiver, coloured by value − exact: a triangle that points up where the value is too
/// large, and down where it is too small, so that a print in grey has the sign, too. Larger errors lie on top. Below the map is
/// what the errors come to.
[[nodiscard]] Drawing draw_error_map(const GreyMap& map, std::span<const Segment> outlines,
                                     std::span<const VerifiedReceiver> receivers, const ErrorSummary& errors,
                                     const ErrorMapCaption& caption);

}  // namespace farlod
