// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// Surely a place that the CRS is meant for. Of degrees whose area is not known, any on the Earth.
[[nodiscard]] bool lies_in_area_of_use(const Crs& crs, Point2d p);

/// Nothing speaks against the place: the area of use is not known, or no farther than 1° away, or than the width of a zone where
/// there are zones: surveys keep one of them for a whole country.
[[nodiscard]] bool may_be_used_at(const Crs& crs, Point2d p);

}  // namespace farlod::georeference
