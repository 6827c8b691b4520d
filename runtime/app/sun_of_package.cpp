// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/sun_of_package.hpp"

#include "farlod/error.hpp"
#include "sun/sun_positions.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/reproject_gdal.hpp"
#endif

namespace farlod {
namespace {

PlaceOnEarth middle_of(const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  const Point2d middle = 0.5 * (package.outline_projected.low + package.outline_projected.high);
  const Point2d degrees = reprojected({&middle, 1}, package.crs_wkt, "EPSG:4326").front();
  return {Angle::degrees(degrees.x), Angle::degrees(degrees.y)};
#else
  throw InputError("--sun needs GDAL, which this farlod-svf was built without, to find out where on the Earth " +
                   package.crs_name + " lies: build it with FARLOD_WITH_GDAL.");
#endif
}

}  // namespace

std::vector<SunPosition> sun_of_package(const PackageDescription& package, const SunPeriod& period) {
  return sun_positions(middle_of(package), period.first, period.days, period.step);
}

}  // namespace farlod
