// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/quantity_options.hpp"
#include "farlod/package.hpp"
#include "results/picture/sky_picture.hpp"
#include "sun/sun_positions.hpp"

namespace farlod {

/// The middle of a package. Throws InputError where it is not known, as without GDAL.
[[nodiscard]] PlaceOnEarth place_of_package(const PackageDescription& package);

/// The positions of the sun in the middle of a package. All of a city has the same: 100 km from there they differ by a degree.
/// Throws InputError where the package's place is not known, as without GDAL.
[[nodiscard]] std::vector<SunPosition> sun_of_package(const PackageDescription& package, const SunPeriod& period);

/// The sun's way on the day of a period, or, where that is a year, on the 21st of June, March and December: the solstices, and an
/// equinox between them. Hours are those of local mean time, as those of sun_of_package. Throws the same.
[[nodiscard]] SunOfSky sun_courses_of_package(const PackageDescription& package, const SunPeriod& period);

}  // namespace farlod
