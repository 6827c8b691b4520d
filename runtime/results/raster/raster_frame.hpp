// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/quantities.hpp"
#include "farlod/raster.hpp"
#include "results/provenance.hpp"

namespace farlod {

/// One of the numbers that a pixel has.
using Band = ColumnDescription;

/// The bands of sky view factors. `quantity` is "svf" or "svf_solid": the name of the first band; `_low` and `_high` behind it
/// are those of the bounds.
[[nodiscard]] std::vector<Band> svf_bands(const std::string& quantity, RasterBands bands);

/// The values of a tile, band by band in the order of RasterFrame::bands. They are those of the tile, and live as long.
[[nodiscard]] std::vector<std::span<const float>> bands_of(const RasterTile& tile);

/// Place, size and bands of a north-up raster in the output CRS, without its values. Row 0 is the northernmost.
struct RasterFrame {
  Point2d north_west_m;  ///< the outer corner of the first pixel, projected frame
  double step_m = 1.0;   ///< edge of a pixel
  std::size_t columns = 0, rows = 0;
  std::vector<Band> bands = {};  ///< at least one
  std::string crs_wkt = {};
  std::optional<int> epsg = {};  ///< the same CRS by its code, where it has one
  std::size_t threads = 1;       ///< of the run; a writer that compresses may use some. They change no byte
  Provenance provenance = {};
  const Package* package = nullptr;  ///< whose outlines and ground a picture shows; none of them where there is none
};

}  // namespace farlod
