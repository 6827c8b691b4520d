// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/svf_options.hpp"
#include "farlod/package.hpp"
#include "farlod/region.hpp"

namespace farlod {

/// The region that --mask or --bbox leaves of a package; null where all of it is asked for, and where --bbox is the extent of a
/// raster. Throws PointsError where a mask cannot be read.
[[nodiscard]] std::shared_ptr<const Region> region_of_package(const SvfOptions& options, const PackageDescription& package);

/// What to tell of a --bbox whose numbers may be longitudes and latitudes (WGS 84).
struct BoxInDegrees {
  std::string note;    ///< that it was taken so; empty where it lies far from the city either way
  std::string beside;  ///< where box and city lie in degrees: behind a message that nothing was answered
};

/// Where --bbox lies far from the city, and is near it as longitudes and latitudes: makes it the box around them in the CRS of
/// the package. None where its numbers are no degrees. Throws PointsError where the latitudes come first.
[[nodiscard]] std::optional<BoxInDegrees> take_degrees_of_bbox(SvfOptions& options, const PackageDescription& package);

}  // namespace farlod
