// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

#include <functional>

// Private to the wrappers of GDAL: it names its classes.

namespace farlod {

/// Band 1 of a raster, without data where a number of it is none, and where the raster says so itself. Pixels are read when they
/// are asked for, from `raster`, which must outlive it.
[[nodiscard]] GDALDatasetUniquePtr cleared_raster(GDALDataset& raster, std::function<bool(double number)> is_none);

}  // namespace farlod
