// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "farlod/point.hpp"
#include "georeference/crs.hpp"

namespace farlod::georeference {

/// Whether a place lies in the area of use of a CRS. If the area of a CRS in degrees is not known: whether it lies on the Earth.
[[nodiscard]] bool lies_in_area_of_use(const Crs& crs, Point2d p);

/// Whether the CRS may be used at a place: the area of use is not known, or is at most 1° away. If the CRS has zones, it may be
/// one zone away, since some surveys use one zone for a whole country.
[[nodiscard]] bool may_be_used_at(const Crs& crs, Point2d p);

}  // namespace farlod::georeference
