// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "package/package_reader.hpp"
#include "receivers/raster_receivers.hpp"

namespace farlod::benchmark {

/// What raster tools make of a city: the highest surface and the ground at the centre of each pixel, row by row from the
/// north-west. Heights as on disk; nothing is at −∞.
struct HeightRaster {
  RasterPlan plan;
  std::vector<float> surface_m, ground_m;
};
[[nodiscard]] HeightRaster rasterise(const PackageReader& package, double pixel_m);

}  // namespace farlod::benchmark
