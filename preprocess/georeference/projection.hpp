// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// Brings points from the CRS of a file to that of the package, in place.
using Projection = std::function<void(std::span<Point3d>)>;

/// By the most exact of the ways that there are. `typical`: a place of the file.
[[nodiscard]] Projection make_projection(const Crs& from, const Crs& to, Point2d typical);

/// Whether a point has a place on some map of the Earth.
[[nodiscard]] bool is_on_a_map(const Point3d& p_projected);

}  // namespace farlod::georeference
