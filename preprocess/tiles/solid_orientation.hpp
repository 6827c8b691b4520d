// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/city_model.hpp"
#include "farlod/point.hpp"

namespace farlod::tiles {

/// The area vector of a facet, and one of its points.
struct OrientedArea {
  Point3d area_vector_m2;
  Point3d point;
  std::uint16_t part = 0;
};

/// For each facet of a building, +1 when it was drawn with its normal outward and −1 otherwise.
/// Files do not agree on which way facets face, but within a closed part they mostly agree with each other: the sign of
/// the part's volume, taken about its middle so that a missing facet changes little, decides for all of them.
[[nodiscard]] std::vector<double> outward_signs(std::span<const OrientedArea> facets);

}  // namespace farlod::tiles
