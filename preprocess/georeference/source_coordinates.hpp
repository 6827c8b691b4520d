// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "city/source.hpp"
#include "georeference/crs.hpp"

namespace farlod {

/// What holds for most buildings of a file, whatever a few stray ones say.
struct TypicalBuilding {
  Point2d place;        ///< median of the buildings' first vertices, by axis
  double extent = 0.0;  ///< median of the larger side of the buildings' upright rectangles
};

/// Of a city with at least one point.
[[nodiscard]] TypicalBuilding typical_building(const CityModel& city);

/// Whether the file writes latitude or northing first. `longitude_first`: it is known not to.
///   (1) degrees come in the authority's order, unless that gives latitudes beyond the poles
///   (2) projected coordinates come easting first, unless only northing first lies in the CRS's area of use
/// The second is what CityGML and CityJSON files do, whatever the authority's order is.
[[nodiscard]] bool is_northing_first(Point2d typical_place, const Crs& crs, bool longitude_first);

/// Throws InputError when the coordinates look like degrees in a file that claims a projected CRS, or the other way round.
void check_units(const SourceCity& source, const TypicalBuilding& typical, const Crs& crs);

/// Puts easting or longitude into x and heights into metres.
void settle_axes(SourceCity& source, const Crs& crs, bool northing_first);

}  // namespace farlod
