// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/quantity_options.hpp"
#include "farlod/package.hpp"

namespace farlod {

/// The positions of the sun in the middle of a package. All of a city has the same: 100 km from there they differ by a degree.
/// Throws InputError where the package's place is not known, as without GDAL.
[[nodiscard]] std::vector<SunPosition> sun_of_package(const PackageDescription& package, const SunPeriod& period);

}  // namespace farlod
