// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "city/source.hpp"
#include "georeference/crs.hpp"
#include "georeference/file_axes.hpp"

namespace farlod::georeference {

/// The typical coordinates of a file, which a few stray buildings do not change. In the units and axes of the file.
struct TypicalPlace {
  /// The median, by axis, of the first vertices of the buildings; without buildings, of the points of the relief.
  Point3d place;
  std::optional<double> building_extent;  ///< median of the larger side of the bounding rectangles of the buildings
  /// The median of the larger side of the facets; without facets, of the distances between consecutive points of the relief. It
  /// tells metres from degrees. Facets are used, since one stray facet can make a building as large as the Earth.
  std::optional<double> grain;
};

/// The source must have at least one point.
[[nodiscard]] TypicalPlace typical_place(const SourceCity& source);

/// The order of the axes by definition: that of the authority, or easting first if the name or the format requires
/// `longitude_first`.
[[nodiscard]] AxisOrder stated_order(const Crs& crs, bool longitude_first);

/// The axes of the file, without the unit of heights.
///   (1) degrees are in the stated order; projected coordinates have the easting first, as in CityGML and CityJSON files, even if
///       the authority has the other order
///   (2) if the CRS cannot be used at that place, another order or a zone number before the easting is assumed, provided that the
///       place then lies in the area of use
[[nodiscard]] FileAxes find_axes(Point2d typical_place, const Crs& crs, bool longitude_first);

/// Whether the coordinates can be in a CRS: those of a geographic CRS look like degrees, those of a projected one do not.
[[nodiscard]] bool may_count_in(const TypicalPlace& typical, const Crs& crs);

/// Throws InputError if the coordinates cannot be in the CRS (may_count_in). `advice` ends the message.
void check_units(const SourceCity& source, const TypicalPlace& typical, const Crs& crs, const std::string& advice);

}  // namespace farlod::georeference
