// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "farlod/package.hpp"
#include "view/view_city.hpp"
#include "view/view_frame.hpp"

namespace farlod {

/// Turned, moved and enlarged alike in all directions, as viewers of 3D Tiles expect it: the axes of `east` and `north`, which
/// are steps of a metre of the map, with the mean of their lengths. Where they are not at right angles, as of a map that is not
/// conformal, both are turned by the same angle.
[[nodiscard]] EcefFromLocal similar_frame(const Point3d& east, const Point3d& north, const Point3d& origin);

/// Where the local frame is on the globe: the tangent of the map at its origin, so that a metre of the map is as long as it is
/// there; heights are enlarged alike, by up to 1 mm a metre in a zone of UTM. They count from the ellipsoid, since the
/// package does not say how far its zero is from it. Needs GDAL; the unit matrix where the CRS is not known, and without GDAL.
[[nodiscard]] EcefFromLocal placed_on_globe(const PackageDescription& description, const ViewFrame& frame);

}  // namespace farlod
