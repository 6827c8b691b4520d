// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/package.hpp"
#include "view/view_city.hpp"
#include "view/view_frame.hpp"

namespace farlod {

/// Where the local frame is on the globe: the tangent of the map at its origin, so that a metre of the map is as long as it is
/// there. Heights count from the ellipsoid, since the package does not say how far its zero is from it. Needs GDAL; the unit
/// matrix where the CRS is not known, and without GDAL.
[[nodiscard]] EcefFromLocal placed_on_globe(const PackageDescription& description, const ViewFrame& frame);

}  // namespace farlod
