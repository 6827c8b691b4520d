// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "app/svf_options.hpp"
#include "farlod/package.hpp"
#include "farlod/region.hpp"

namespace farlod {

/// The region that --mask or --bbox leaves of a package; null where all of it is asked for, and where --bbox is the extent of a
/// raster. Throws PointsError where a mask cannot be read.
[[nodiscard]] std::shared_ptr<const Region> region_of_package(const SvfOptions& options, const PackageDescription& package);

}  // namespace farlod
